// What both pages read of scene.json, as three.js has it.

import {
  BufferAttribute, BufferGeometry, Camera, DataTexture, Matrix4, Mesh, NoColorSpace, SRGBColorSpace,
} from "three";

export const picture = await (await fetch("scene.json")).json();

/** The name of the scene to draw. Throws an error with those that there are. */
export function sceneName(known) {
  const name = new URLSearchParams(location.search).get("draw") ?? "plastic";
  if (!known.includes(name)) throw new Error(`there is no scene \`${name}\`: there are ${known.join(", ")}`);
  return name;
}

/** Meshes have three.js's names of attributes, and bones as small numbers, as its loaders give them. */
export function geometryOf(name) {
  const { position, normal, tangent, uv, joints, weights, indices } = picture.meshes[name];
  const geometry = new BufferGeometry();
  const put = (key, numbers, lanes, kind = Float32Array) =>
    numbers && geometry.setAttribute(key, new BufferAttribute(new kind(numbers), lanes));
  put("position", position, 3);
  put("normal", normal, 3);
  put("tangent", tangent, 4);
  put("uv", uv, 2);
  put("skinIndex", joints, 4, Uint16Array);
  put("skinWeight", weights, 4);
  return geometry.setIndex(indices);
}

/** Rows come from the top, as Burnish reads them: `flipY` stays false. */
export function textureOf(name, isColor) {
  const { width, height, rgba } = picture.pictures[name];
  const made = new DataTexture(new Uint8Array(rgba), width, height);
  made.colorSpace = isColor ? SRGBColorSpace : NoColorSpace;
  made.needsUpdate = true;
  return made;
}

/** A mesh of the scene with a material. */
export function meshOf({ mesh, object_to_world }, material) {
  const made = new Mesh(geometryOf(mesh), material);
  made.matrixAutoUpdate = false;
  made.matrix.fromArray(object_to_world);
  return made;
}

/** A camera with the scene's matrix, whose depths are from 0 to 1, and `near` what three.js has there. */
export function cameraOf({ eye, view_projection }, near = -1) {
  const camera = new Camera();
  camera.position.fromArray(eye);
  const depths = new Matrix4().makeTranslation(0, 0, near).scale({ x: 1, y: 1, z: 1 - near });
  camera.projectionMatrix.copy(depths).multiply(new Matrix4().fromArray(view_projection));
  camera.projectionMatrix.multiply(new Matrix4().makeTranslation(...eye));
  camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
  return camera;
}
