import plastic from "./materials/plastic.burnish";

export let fragment = plastic.Plastic.texts.wgsl.fragment;

import.meta.hot?.accept("./materials/plastic.burnish", (changed) => {
  fragment = changed.default.Plastic.texts.wgsl.fragment;
});
