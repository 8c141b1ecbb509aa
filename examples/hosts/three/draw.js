// Draws the scenes of scene.json by three.js's WebGLRenderer, with materials by Burnish.

import {
  Color, DepthTexture, FloatType, Matrix4, MeshBasicMaterial, DoubleSide, PerspectiveCamera, Scene,
  Vector3, WebGLRenderer, WebGLRenderTarget,
} from "three";
import { BannerMaterial } from "./build/Banner.three-webgl.js";
import { ClayMaterial } from "./build/Clay.three-webgl.js";
import { PlasticMaterial } from "./build/Plastic.three-webgl.js";
import { SlateMaterial } from "./build/Slate.three-webgl.js";
import { cameraOf, meshOf, picture, sceneName, textureOf } from "./scene.js";

const vector = (numbers) => new Vector3(...numbers);

// -- glue
const materials = {
  plastic: ({ sun, lamps, torch }) => ({
    Plastic: new PlasticMaterial({
      albedo: textureOf("tiles", true),
      sun_direction: vector(sun.direction),
      lamps: lamps.map((lamp) => ({ place: vector(lamp.place), diffuse_color: new Color(...lamp.diffuse_color) })),
      torch_place: vector(torch.place),
      torch_axis: vector(torch.axis),
    }),
  }),
  banner: ({ sun }) => ({
    Banner: new BannerMaterial({
      normal_map: textureOf("threads", false),
      sun_direction: vector(sun.direction),
      bones: new Float32Array(picture.bones.flat()),
    }),
  }),
  shadows: ({ lamp }, shadow) => {
    const values = { ...shadow, lamp_place: vector(lamp.place), lamp_axis: vector(lamp.axis) };
    return { Clay: new ClayMaterial(values), Slate: new SlateMaterial(values) };
  },
};
// -- end of glue

/** What the lamp sees: a depth texture, and the matrix by which materials find a point in it. */
function shadowOf({ place, axis }) {
  const camera = new PerspectiveCamera(70, 1, 0.5, 12);
  camera.position.fromArray(place);
  camera.lookAt(vector(place).add(vector(axis)));
  camera.updateMatrixWorld();
  const from_lamp = new Matrix4().makeTranslation(0, 0, 0.5).scale(new Vector3(1, 1, 0.5));
  from_lamp.multiply(camera.projectionMatrix).multiply(camera.matrixWorldInverse);
  // Its first row is the upper one, as Burnish reads textures.
  camera.projectionMatrix.elements[5] *= -1;
  const map = new WebGLRenderTarget(512, 512, { depthTexture: new DepthTexture(512, 512, FloatType) });
  return { camera, map, values: { from_lamp, shadow: map.depthTexture } };
}

function draw(name) {
  const canvas = document.querySelector("canvas");
  const renderer = new WebGLRenderer({ canvas, preserveDrawingBuffer: true });
  const { models, lights } = picture.scenes[name];
  const shadow = name === "shadows" ? shadowOf(lights.lamp) : undefined;
  const made = materials[name](lights, shadow?.values);
  const scene = new Scene();
  for (const model of models) scene.add(meshOf(model, made[model.material]));
  if (shadow) {
    scene.overrideMaterial = new MeshBasicMaterial({ side: DoubleSide });
    renderer.setRenderTarget(shadow.map);
    renderer.render(scene, shadow.camera);
    renderer.setRenderTarget(null);
    scene.overrideMaterial = null;
  }
  renderer.render(scene, cameraOf(picture.camera));
}

try {
  draw(sceneName(Object.keys(materials)));
} catch (error) {
  document.querySelector("#told").textContent = error.message;
}
window.drawn = true;
