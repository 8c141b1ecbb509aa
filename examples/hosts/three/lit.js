// Draws a material of scene.json in three.js's own light: its slots are functions in nodes.

import { AmbientLight, DirectionalLight, PointLight, Scene, WebGPURenderer } from "three/webgpu";
import { PlasticMaterial } from "./build/Plastic.three.js";
import { cameraOf, meshOf, picture, sceneName, textureOf } from "./scene.js";

// -- glue
const materials = {
  plastic: () => new PlasticMaterial({ albedo: textureOf("tiles", true) }),
};
// -- end of glue

async function draw(name) {
  const canvas = document.querySelector("canvas");
  const renderer = new WebGPURenderer({ canvas, forceWebGL: new URLSearchParams(location.search).has("webgl") });
  await renderer.init();
  const material = materials[name]();
  material.roughness = 0.35;
  const scene = new Scene();
  for (const model of picture.scenes[name].models) scene.add(meshOf(model, material));
  const { sun, lamps = [] } = picture.scenes[name].lights;
  const day = new DirectionalLight(0xffffff, 2.5);
  day.position.fromArray(sun.direction).negate();
  scene.add(day, new AmbientLight(0xffffff, 0.4));
  for (const lamp of lamps) {
    const made = new PointLight(0xffffff, 4);
    made.position.fromArray(lamp.place);
    made.color.setRGB(...lamp.diffuse_color);
    scene.add(made);
  }
  const camera = cameraOf(picture.camera, renderer.backend.isWebGPUBackend ? 0 : -1);
  camera.coordinateSystem = renderer.coordinateSystem;
  renderer.render(scene, camera);
}

try {
  await draw(sceneName(Object.keys(materials)));
} catch (error) {
  document.querySelector("#told").textContent = error.message;
}
window.drawn = true;
