//! Composes shaders as Bevy does, with Bevy's own modules, and validates them.
//!
//! `bevy-composer MODULES JOBS`: a line of JOBS is the path of a shader and, behind a tab each,
//! its definitions: `SKINNED`, or `MATERIAL_BIND_GROUP=3`. A line of the output is `taken`, or
//! `refused` with the reason in one line.

use naga_oil::compose::{
    ComposableModuleDescriptor, Composer, ComposerError, NagaModuleDescriptor, ShaderDefValue,
};
use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::{env, fs, process};

/// All files of a folder whose name ends with `.wgsl`, in the order of their paths.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_path_buf()];
    while let Some(each) = folders.pop() {
        for entry in fs::read_dir(&each).expect("the folder of modules is read") {
            let path = entry.expect("an entry of the folder is read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|name| name == "wgsl") {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

/// A composer that knows all modules; those that import others come behind these.
fn composer(folder: &Path) -> Composer {
    let mut composer =
        Composer::default().with_capabilities(naga::valid::Capabilities::all());
    let mut left: Vec<(PathBuf, String)> = sources(folder)
        .into_iter()
        .map(|path| (path.clone(), fs::read_to_string(path).expect("a module is read")))
        .filter(|(_, source)| source.contains("#define_import_path"))
        .collect();
    loop {
        let before = left.len();
        let mut refused = Vec::new();
        for (path, source) in left {
            let known = composer.add_composable_module(ComposableModuleDescriptor {
                source: &source,
                file_path: &path.to_string_lossy(),
                ..Default::default()
            });
            if known.is_err() {
                refused.push((path, source));
            }
        }
        if refused.len() == before || refused.is_empty() {
            return composer;
        }
        left = refused;
    }
}

fn definitions<'a>(words: impl Iterator<Item = &'a str>) -> HashMap<String, ShaderDefValue> {
    words
        .map(|word| match word.split_once('=') {
            Some((name, number)) => {
                let number = number.parse().expect("a definition is a number");
                (name.to_string(), ShaderDefValue::UInt(number))
            }
            None => (word.to_string(), ShaderDefValue::Bool(true)),
        })
        .collect()
}

/// The error with all its causes, in one line.
fn told(composer: &Composer, error: &ComposerError) -> String {
    error.emit_to_string(composer).split_whitespace().collect::<Vec<_>>().join(" ")
}

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [modules, jobs] = arguments.as_slice() else {
        eprintln!("usage: bevy-composer MODULES JOBS");
        process::exit(2);
    };
    let mut composer = composer(Path::new(modules));
    for job in fs::read_to_string(jobs).expect("the jobs are read").lines() {
        let mut words = job.split('\t');
        let path = words.next().expect("a line has a path");
        let source = fs::read_to_string(path).expect("a shader is read");
        let made = composer.make_naga_module(NagaModuleDescriptor {
            source: &source,
            file_path: path,
            shader_defs: definitions(words),
            ..Default::default()
        });
        match made {
            Ok(_) => println!("taken"),
            Err(error) => println!("refused {}", told(&composer, &error)),
        }
    }
}
