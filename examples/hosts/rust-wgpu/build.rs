fn main() {
    burnish_build::Materials::new(["materials/plastic.burnish", "materials/banner.burnish"])
        .targets(["wgsl"])
        .bindings("shaders.rs")
        .compile();
}
