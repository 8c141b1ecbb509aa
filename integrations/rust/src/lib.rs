//! Compiles materials of Burnish in a build script, `build.rs`.
//!
//! ```no_run
//! # #[allow(clippy::needless_doctest_main)]
//! fn main() {
//!     burnish_build::Materials::new(["materials/plastic.burnish"])
//!         .targets(["wgsl"])
//!         .bindings("materials.rs")
//!         .compile();
//! }
//! ```
//!
//! The program then includes what was written, and is built again when a material has changed, or
//! any file that it imports:
//!
//! ```ignore
//! const FRAGMENT: &str = include_str!(concat!(env!("OUT_DIR"), "/Plastic.frag.wgsl"));
//!
//! mod materials {
//!     include!(concat!(env!("OUT_DIR"), "/materials.rs"));
//! }
//! ```
//!
//! The crate runs the program `burnish` of the `PATH`; the variable `BURNISH` names another one.

use std::env;
use std::ffi::{OsStr, OsString};
use std::fmt;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{self, Command};

mod depfile;
mod findings;

/// The variable of the environment that names the program.
const PROGRAM: &str = "BURNISH";

/// Materials that are compiled together, and how.
#[derive(Clone, Debug)]
pub struct Materials {
    files: Vec<PathBuf>,
    options: Vec<OsString>,
    folder: Option<PathBuf>,
    bindings: Option<PathBuf>,
}

impl Materials {
    /// The materials of these files, whose paths are relative to the package.
    pub fn new<P: Into<PathBuf>>(files: impl IntoIterator<Item = P>) -> Self {
        Materials {
            files: files.into_iter().map(Into::into).collect(),
            options: Vec::new(),
            folder: None,
            bindings: None,
        }
    }

    /// The languages to write, such as `wgsl` or `glsl:es300`; without this, those that
    /// `burnish compile` writes by default.
    pub fn targets<S: AsRef<OsStr>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        for name in names {
            self.options.push("--target".into());
            self.options.push(name.as_ref().into());
        }
        self
    }

    /// A folder in which imported files are looked for.
    pub fn include(self, folder: impl Into<PathBuf>) -> Self {
        self.option("--include").option(folder.into())
    }

    /// One more word of the command line of `burnish compile`, such as `--rig` and then `Night`.
    /// With `bindings`, it has to be one that `burnish bind` takes as well.
    pub fn option(mut self, word: impl Into<OsString>) -> Self {
        self.options.push(word.into());
        self
    }

    /// The folder to write to; by default Cargo's `OUT_DIR`.
    pub fn output_folder(mut self, folder: impl Into<PathBuf>) -> Self {
        self.folder = Some(folder.into());
        self
    }

    /// Also write a file with the binding of all materials, by `burnish bind`: their blocks as
    /// structures, and tables that have the texts of the shaders. Its name is relative to the folder
    /// to write to.
    pub fn bindings(mut self, file: impl Into<PathBuf>) -> Self {
        self.bindings = Some(file.into());
        self
    }

    /// Compile, and tell Cargo which files were read. If something is wrong, the build script ends
    /// with the messages.
    pub fn compile(self) -> Vec<PathBuf> {
        self.try_compile().unwrap_or_else(|error| {
            eprintln!("{error}");
            process::exit(1)
        })
    }

    /// Compile, tell Cargo which files were read, and return the paths that were written.
    pub fn try_compile(self) -> Result<Vec<PathBuf>, Error> {
        println!("cargo:rerun-if-env-changed={PROGRAM}");
        for file in &self.files {
            watch(file);
        }
        let scratch = out_dir()?.join("burnish.d");
        let folder = match &self.folder {
            Some(folder) => folder.clone(),
            None => out_dir()?,
        };
        for line in findings::lines(&self.run_compile(&folder, &scratch)?) {
            println!("cargo:warning={line}");
        }
        let rule = fs::read_to_string(&scratch).map_err(|error| Error::file(&scratch, error))?;
        let (outputs, inputs) = depfile::parsed(&rule);
        for input in &inputs {
            watch(Path::new(input));
        }
        let mut outputs: Vec<_> = outputs.into_iter().map(PathBuf::from).collect();
        if let Some(file) = &self.bindings {
            // The features of the program that add to a binding; it may lack both.
            println!("cargo:rustc-check-cfg=cfg(feature, values(\"bytemuck\", \"wgpu\"))");
            let path = folder.join(file);
            self.run_bind(&path)?;
            outputs.push(path);
        }
        Ok(outputs)
    }

    fn run_compile(&self, folder: &Path, scratch: &Path) -> Result<String, Error> {
        let options = [
            "--format".as_ref(),
            "line".as_ref(),
            "--output".as_ref(),
            folder.as_os_str(),
        ];
        let depfile = ["--depfile".as_ref(), scratch.as_os_str()];
        self.run("compile", options.into_iter().chain(depfile))
    }

    fn run_bind(&self, file: &Path) -> Result<String, Error> {
        let options = ["--lang", "rust", "--embed", "--output"].map(OsStr::new);
        self.run("bind", options.into_iter().chain([file.as_os_str()]))
    }

    /// What a command says of the files, beside what it writes.
    fn run<'a>(
        &self,
        command: &str,
        options: impl Iterator<Item = &'a OsStr>,
    ) -> Result<String, Error> {
        let program = env::var_os(PROGRAM).unwrap_or_else(|| "burnish".into());
        let ended = Command::new(&program)
            .arg(command)
            .args(&self.options)
            .args(options)
            .arg("--")
            .args(&self.files)
            .output()
            .map_err(|error| Error::NotRun(program.to_string_lossy().into_owned(), error))?;
        let said = String::from_utf8_lossy(&ended.stderr);
        if !ended.status.success() {
            return Err(Error::Refused(said.trim_end().to_owned()));
        }
        Ok(said.into_owned())
    }
}

/// The reason why nothing was compiled. As a text, it is for the people who build.
#[derive(Debug)]
pub enum Error {
    /// The program cannot be run.
    NotRun(String, io::Error),
    /// It has found mistakes, and this is what it said.
    Refused(String),
    /// A file cannot be read.
    File(PathBuf, io::Error),
    /// Cargo has not said where to write: this is no build script.
    NoFolder,
}

impl Error {
    fn file(path: &Path, error: io::Error) -> Self {
        Error::File(path.to_owned(), error)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Error::NotRun(program, error) => write!(
                to,
                "burnish-build: cannot run `{program}` ({error}): activate the Python environment \
                 in which Burnish is installed, or name the program by the variable {PROGRAM}"
            ),
            Error::Refused(said) => to.write_str(said),
            Error::File(path, error) => {
                write!(
                    to,
                    "burnish-build: cannot read `{}`: {error}",
                    path.display()
                )
            }
            Error::NoFolder => to.write_str(
                "burnish-build: there is no variable OUT_DIR, which Cargo sets for build scripts: \
                 call this from build.rs",
            ),
        }
    }
}

impl std::error::Error for Error {}

/// Have Cargo run the build script again when a file has changed.
fn watch(file: &Path) {
    println!("cargo:rerun-if-changed={}", file.display());
}

fn out_dir() -> Result<PathBuf, Error> {
    env::var_os("OUT_DIR")
        .map(PathBuf::from)
        .ok_or(Error::NoFolder)
}
