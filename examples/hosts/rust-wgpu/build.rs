fn main() {
    let names = ["plastic", "banner", "shadows"];
    burnish_build::Materials::new(names.map(|name| format!("materials/{name}.burnish")))
        .targets(["wgsl"])
        .bindings("shaders.rs")
        .compile();
}
