//! Prints what the comparer in Rust says of each case of a list; `kit.py` tells the form.

mod burnish_judge;

use burnish_judge::{judge, Bounds, Encoding, JudgeError, Picture};

/// The verdict, or the error.
fn said(
    bounds: impl FnOnce() -> Result<Bounds, JudgeError>,
    picture: Result<Picture, JudgeError>,
    encoding: &str,
    lanes: &str,
) -> String {
    let encoding = if encoding == "srgb" { Encoding::Srgb } else { Encoding::Linear };
    let verdict = picture.and_then(|mut picture| {
        if let Ok(lanes) = lanes.parse() {
            picture.lanes = lanes;
        }
        judge(&bounds()?, &picture, encoding)
    });
    match verdict {
        Ok(verdict) => verdict.to_string(),
        Err(error) => format!("error: {error}"),
    }
}

fn main() {
    let list = std::env::args().nth(1).expect("a list");
    for line in std::fs::read_to_string(list).expect("the list").lines() {
        let fields: Vec<&str> = line.split('\t').collect();
        let (folder, output, path) = (fields[0], fields[1], fields[2]);
        let (encoding, lanes) = (fields[3], fields[4]);
        let content = |path: &str| std::fs::read(path).unwrap_or_default();
        let lower = content(&format!("{folder}/{output}.lower.npy"));
        let upper = content(&format!("{folder}/{output}.upper.npy"));
        let undecided = content(&format!("{folder}/undecided.npy"));
        let load = || Bounds::load(folder, output);
        let parse = || Bounds::parse(&lower, &upper, &undecided);
        let loaded = said(load, Picture::load(path), encoding, lanes);
        let parsed = said(parse, Picture::parse(&content(path)), encoding, lanes);
        println!("{loaded}\t{parsed}");
    }
}
