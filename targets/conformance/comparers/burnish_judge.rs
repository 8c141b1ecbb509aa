// SPDX-License-Identifier: Apache-2.0

//! Judges pictures by the bounds of a golden folder. Copy this file into your own test suite.
//!
//! `burnish conform FILE --golden FOLDER` writes a golden folder: for each case, and each output of
//! it, the lowest and the highest value that a conforming device may draw at each pixel. This file
//! needs nothing but the standard library, and comes in Python, Rust, TypeScript and C++, with the
//! same names and the same verdicts. A test loads the bounds, draws, and asks for the verdict:
//!
//! ```ignore
//! let bounds = Bounds::load("golden/Plastic/defaults", "color")?;
//! let picture = Picture { width: 72, height: 56, lanes: 4, data: Samples::U8(pixels) };
//! let verdict = judge(&bounds, &picture, Encoding::Srgb)?;
//! assert!(verdict.is_good(), "{verdict}");
//! ```
//!
//! On the command line: `rustc --edition 2021 -O burnish_judge.rs`, then
//! `./burnish_judge FOLDER OUTPUT PICTURE.npy [linear|srgb]`

#![allow(dead_code)] // A test suite may need only a part of this.

use std::error::Error;
use std::fmt;
use std::path::Path;
use std::process::ExitCode;

/// Nothing can be judged: a damaged file, a picture of another size, or nothing to compare.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct JudgeError(String);

impl fmt::Display for JudgeError {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str(&self.0)
    }
}

impl Error for JudgeError {}

/// The way in which a picture of integers has values; pictures of floats have them as such.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// A value is its code divided by the largest code.
    #[default]
    Linear,
    /// The first three lanes have the transfer function of sRGB; the fourth, alpha, is linear.
    Srgb,
}

/// The numbers of a picture.
#[derive(Clone, Debug, PartialEq)]
pub enum Samples {
    U8(Vec<u8>),
    U16(Vec<u16>),
    F32(Vec<f32>),
    F64(Vec<f64>),
}

/// A picture in memory: row by row from the top, with the lanes of each pixel side by side.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    pub width: usize,
    pub height: usize,
    pub lanes: usize,
    pub data: Samples,
}

/// The values that a conforming device may draw, for one output of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Bounds {
    pub width: usize,
    pub height: usize,
    pub lanes: usize,
    /// The lowest value of each lane of each pixel, in the order of `Picture::data`.
    pub lower: Vec<f64>,
    /// The highest value, likewise.
    pub upper: Vec<f64>,
    /// For each pixel, 1 if it is not compared, else 0.
    pub undecided: Vec<u8>,
}

/// A lane of a pixel that is outside of its bounds, counted from 0 at the left and the top.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outlier {
    pub x: usize,
    pub y: usize,
    pub lane: usize,
    /// The number as the picture has it: of a picture of integers, the code.
    pub value: f64,
    /// The lowest number that it may be: of a picture of integers, a code.
    pub lower: f64,
    /// The highest number, likewise.
    pub upper: f64,
    /// The distance to the nearer end, for codes divided by the largest one. It is infinite for a
    /// NaN.
    pub distance: f64,
}

/// The result of a comparison, in pixels. Shown as text, it is one line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Verdict {
    pub compared: usize,
    pub undecided: usize,
    pub outside: usize,
    /// The lane that is farthest outside. Of equally far ones, it is the first in the rows.
    pub worst: Option<Outlier>,
}

impl Picture {
    /// The picture in a `.npy` file: (height, width) or (height, width, lanes).
    pub fn load(path: impl AsRef<Path>) -> Result<Self, JudgeError> {
        Npy::load(path.as_ref()).map(Self::of)
    }

    /// The picture in the bytes of a `.npy` file.
    pub fn parse(content: &[u8]) -> Result<Self, JudgeError> {
        Npy::parse("picture.npy", content).map(Self::of)
    }

    fn of(file: Npy) -> Self {
        Self {
            width: file.width,
            height: file.height,
            lanes: file.lanes,
            data: file.samples,
        }
    }
}

impl Bounds {
    /// The bounds in the folder of a case, `golden/Plastic/defaults`, for one output.
    pub fn load(folder: impl AsRef<Path>, output: &str) -> Result<Self, JudgeError> {
        let file = |name: String| Npy::load(&folder.as_ref().join(name));
        Self::of(
            file(format!("{output}.lower.npy"))?,
            file(format!("{output}.upper.npy"))?,
            file("undecided.npy".to_owned())?,
        )
    }

    /// The bounds in the bytes of the three files.
    pub fn parse(lower: &[u8], upper: &[u8], undecided: &[u8]) -> Result<Self, JudgeError> {
        Self::of(
            Npy::parse("lower.npy", lower)?,
            Npy::parse("upper.npy", upper)?,
            Npy::parse("undecided.npy", undecided)?,
        )
    }

    fn of(lower: Npy, upper: Npy, undecided: Npy) -> Result<Self, JudgeError> {
        let (name, width, height, lanes) =
            (lower.name.clone(), lower.width, lower.height, lower.lanes);
        let lower = lower.doubles([width, height, lanes])?;
        let upper = upper.doubles([width, height, lanes])?;
        let undecided = undecided.marks([width, height, 1])?;
        for (index, (&low, &high)) in lower.iter().zip(&upper).enumerate() {
            if low.is_nan() || high.is_nan() || low > high {
                let (pixel, lane) = (index / lanes, index % lanes);
                let (x, y, low, high) = (pixel % width, pixel / width, shown(low), shown(high));
                return fail(format!(
                    "{name}: is damaged at x {x}, y {y}, lane {lane}: lower is {low}, upper {high}"
                ));
            }
        }
        Ok(Self {
            width,
            height,
            lanes,
            lower,
            upper,
            undecided,
        })
    }
}

impl Verdict {
    /// True if no pixel is outside of its bounds.
    pub fn is_good(&self) -> bool {
        self.outside == 0
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            to,
            "{}: {} pixels compared, {} undecided, {} outside of the bounds",
            if self.is_good() { "good" } else { "bad" },
            self.compared,
            self.undecided,
            self.outside
        )?;
        if let Some(Outlier {
            x,
            y,
            lane,
            value,
            lower,
            upper,
            ..
        }) = self.worst
        {
            let (value, lower, upper) = (shown(value), shown(lower), shown(upper));
            write!(to, "; the worst, at x {x}, y {y}, lane {lane}, ")?;
            write!(to, "is {value}, not within {lower} .. {upper}")?;
        }
        Ok(())
    }
}

/// Compares a picture with the bounds. An error says why that is not possible.
pub fn judge(
    bounds: &Bounds,
    picture: &Picture,
    encoding: Encoding,
) -> Result<Verdict, JudgeError> {
    check_shape(bounds, picture)?;
    let largest = picture.data.largest();
    if largest.is_none() && encoding == Encoding::Srgb {
        return fail("the picture has floats, which are linear: only integers are encoded");
    }
    let mut verdict = Verdict {
        compared: 0,
        undecided: 0,
        outside: 0,
        worst: None,
    };
    for (pixel, &is_undecided) in bounds.undecided.iter().enumerate() {
        if is_undecided != 0 {
            verdict.undecided += 1;
            continue;
        }
        verdict.compared += 1;
        let mut is_outside = false;
        for lane in 0..picture.lanes {
            let at = pixel * bounds.lanes + lane;
            let (mut lower, mut upper) = (bounds.lower[at], bounds.upper[at]);
            if let Some(largest) = largest {
                let is_srgb = encoding == Encoding::Srgb && lane < 3;
                (lower, upper) = codes(lower, upper, largest, is_srgb);
            }
            let value = picture.data.at(pixel * picture.lanes + lane);
            if (lower..=upper).contains(&value) {
                continue;
            }
            is_outside = true;
            let distance = distance(value, lower, upper) / largest.unwrap_or(1.0);
            if distance > verdict.worst.map_or(0.0, |worst| worst.distance) {
                let (x, y) = (pixel % bounds.width, pixel / bounds.width);
                verdict.worst = Some(Outlier {
                    x,
                    y,
                    lane,
                    value,
                    lower,
                    upper,
                    distance,
                });
            }
        }
        verdict.outside += usize::from(is_outside);
    }
    if verdict.compared == 0 {
        return fail("nothing is compared: every pixel is undecided");
    }
    Ok(verdict)
}

// How numbers are compared.

/// An error for a picture that does not fit the bounds.
fn check_shape(bounds: &Bounds, picture: &Picture) -> Result<(), JudgeError> {
    let Picture {
        width,
        height,
        lanes,
        ..
    } = *picture;
    if (width, height) != (bounds.width, bounds.height) {
        return fail(format!(
            "the picture has {width} x {height} pixels, but the bounds have {} x {}",
            bounds.width, bounds.height
        ));
    }
    if !(1..=bounds.lanes).contains(&lanes) {
        let available = bounds.lanes;
        return fail(format!(
            "the picture has {lanes} lanes, but the bounds have {available}"
        ));
    }
    let (count, expected) = (picture.data.len(), width * height * lanes);
    if count != expected {
        return fail(format!(
            "the picture has {count} numbers, but its size needs {expected}"
        ));
    }
    Ok(())
}

/// The codes that bounds allow: a format may round a value to either neighbour.
fn codes(lower: f64, upper: f64, largest: f64, is_srgb: bool) -> (f64, f64) {
    let encoded = |end: f64| {
        let end = end.clamp(0.0, 1.0);
        largest * if is_srgb { srgb(end) } else { end }
    };
    (encoded(lower).floor(), encoded(upper).ceil())
}

/// The transfer function of sRGB (IEC 61966-2-1), from linear light.
fn srgb(value: f64) -> f64 {
    if value <= 0.0031308 {
        12.92 * value
    } else {
        1.0 + 1.055 * (value.powf(1.0 / 2.4) - 1.0)
    }
}

/// The distance of a value that is outside to the nearer end.
fn distance(value: f64, lower: f64, upper: f64) -> f64 {
    if value.is_nan() {
        f64::INFINITY
    } else if value < lower {
        lower - value
    } else {
        value - upper
    }
}

impl Samples {
    /// The largest code of integers; floats have none.
    fn largest(&self) -> Option<f64> {
        match self {
            Self::U8(_) => Some(f64::from(u8::MAX)),
            Self::U16(_) => Some(f64::from(u16::MAX)),
            Self::F32(_) | Self::F64(_) => None,
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::U8(numbers) => numbers.len(),
            Self::U16(numbers) => numbers.len(),
            Self::F32(numbers) => numbers.len(),
            Self::F64(numbers) => numbers.len(),
        }
    }

    fn at(&self, index: usize) -> f64 {
        match self {
            Self::U8(numbers) => f64::from(numbers[index]),
            Self::U16(numbers) => f64::from(numbers[index]),
            Self::F32(numbers) => f64::from(numbers[index]),
            Self::F64(numbers) => numbers[index],
        }
    }
}

// How numbers are shown: in all four languages alike.

/// The shortest decimal that means the same number. Of two that are equally near, it is the even
/// one, as in other languages: Rust itself takes the larger one.
fn shown(number: f64) -> String {
    let number = number + 0.0; // without the sign of a negative zero
    if number == 0.0 || !number.is_finite() {
        return number.to_string();
    }
    let is_usual = (1e-4..1e16).contains(&number.abs());
    let shortest = if is_usual {
        number.to_string()
    } else {
        format!("{number:e}")
    };
    let decimals = shortest
        .split('e')
        .next()
        .and_then(|digits| digits.split_once('.'));
    let count = decimals.map_or(0, |(_, decimals)| decimals.len());
    let even = if is_usual {
        format!("{number:.count$}")
    } else {
        format!("{number:.count$e}")
    };
    if even.parse() == Ok(number) {
        even
    } else {
        shortest
    }
}

fn fail<T>(message: impl Into<String>) -> Result<T, JudgeError> {
    Err(JudgeError(message.into()))
}

// The format `.npy` of NumPy, as far as pictures need it.

const LONGEST_SIDE: usize = 65536;

/// The content of a `.npy` file, a picture.
struct Npy {
    name: String,
    kind: String,
    width: usize,
    height: usize,
    lanes: usize,
    samples: Samples,
}

impl Npy {
    fn load(path: &Path) -> Result<Self, JudgeError> {
        let name = path.display().to_string();
        match std::fs::read(path) {
            Ok(content) => Self::parse(&name, &content),
            Err(error) => fail(format!("{name}: cannot be read: {error}")),
        }
    }

    fn parse(name: &str, content: &[u8]) -> Result<Self, JudgeError> {
        let (header, data) = split(name, content)?;
        let kind = between(name, header, "descr", '\'', '\'')?;
        let size = match kind {
            "|u1" => 1,
            "<u2" | "<f2" => 2,
            "<f4" => 4,
            "<f8" => 8,
            _ => {
                let known = "|u1, <u2, <f2, <f4 and <f8";
                return fail(format!(
                    "{name}: has numbers of type {kind}; known are {known}"
                ));
            }
        };
        if !value(name, header, "fortran_order")?.starts_with("False") {
            return fail(format!("{name}: is not in C order, row by row"));
        }
        let [height, width, lanes] = shape(name, between(name, header, "shape", '(', ')')?)?;
        let needed = height as u64 * width as u64 * lanes as u64 * size;
        if data.len() as u64 != needed {
            let found = data.len();
            return fail(format!(
                "{name}: has {found} bytes of numbers, but needs {needed}"
            ));
        }
        let samples = numbers(kind, data);
        Ok(Self {
            name: name.to_owned(),
            kind: kind.to_owned(),
            width,
            height,
            lanes,
            samples,
        })
    }

    /// Its numbers, which have to be doubles: so many for the width, the height, and the lanes.
    fn doubles(self, size: [usize; 3]) -> Result<Vec<f64>, JudgeError> {
        self.check_size(size)?;
        match self.samples {
            Samples::F64(numbers) => Ok(numbers),
            _ => fail(format!(
                "{}: has numbers of type {}, not <f8",
                self.name, self.kind
            )),
        }
    }

    /// Its numbers, which have to be 0 or 1, likewise.
    fn marks(self, size: [usize; 3]) -> Result<Vec<u8>, JudgeError> {
        self.check_size(size)?;
        let marks = match self.samples {
            Samples::U8(numbers) => numbers,
            _ => {
                return fail(format!(
                    "{}: has numbers of type {}, not |u1",
                    self.name, self.kind
                ))
            }
        };
        match marks.iter().find(|&&mark| mark > 1) {
            Some(mark) => fail(format!(
                "{}: is damaged: it has a {mark}, not just 0 and 1",
                self.name
            )),
            None => Ok(marks),
        }
    }

    fn check_size(&self, [width, height, lanes]: [usize; 3]) -> Result<(), JudgeError> {
        if [self.width, self.height, self.lanes] == [width, height, lanes] {
            return Ok(());
        }
        fail(format!(
            "{}: has {} x {} pixels of {} lanes, not {width} x {height} of {lanes}",
            self.name, self.width, self.height, self.lanes
        ))
    }
}

/// The header and the data of a `.npy` file.
fn split<'a>(name: &str, content: &'a [u8]) -> Result<(&'a str, &'a [u8]), JudgeError> {
    if content.len() < 8 || !content.starts_with(b"\x93NUMPY") {
        return fail(format!("{name}: is no .npy file"));
    }
    let (major, minor) = (content[6], content[7]);
    if !(1..=3).contains(&major) || minor != 0 {
        return fail(format!(
            "{name}: has version {major}.{minor} of the .npy format, not 1.0 to 3.0"
        ));
    }
    let start = if major == 1 { 10 } else { 12 };
    let length = content.get(8..start).map(|bytes| {
        bytes
            .iter()
            .rev()
            .fold(0, |length, &byte| length << 8 | usize::from(byte))
    });
    let end = length.and_then(|length| start.checked_add(length));
    let header = end
        .and_then(|end| content.get(start..end))
        .filter(|header| {
            header
                .iter()
                .all(|&byte| byte == b'\n' || (32..127).contains(&byte))
        });
    match header.map(std::str::from_utf8) {
        Some(Ok(header)) => Ok((header, &content[start + header.len()..])),
        _ => fail(format!("{name}: has a damaged header")),
    }
}

/// The rest of a header, from the value of a key on.
fn value<'a>(name: &str, header: &'a str, key: &str) -> Result<&'a str, JudgeError> {
    header
        .split_once(&format!("'{key}'"))
        .and_then(|(_, rest)| rest.trim_start().strip_prefix(':'))
        .map(|rest| rest.trim_start())
        .ok_or_else(|| JudgeError(format!("{name}: has a damaged header: no {key}")))
}

/// The text between the two letters that enclose the value of a key.
fn between<'a>(
    name: &str,
    header: &'a str,
    key: &str,
    first: char,
    last: char,
) -> Result<&'a str, JudgeError> {
    value(name, header, key)?
        .strip_prefix(first)
        .and_then(|rest| rest.split_once(last))
        .map(|(inner, _)| inner)
        .ok_or_else(|| JudgeError(format!("{name}: has a damaged header: no {key}")))
}

/// The height, the width and the lanes in a header's shape, `56, 72, 4` or `56, 72`.
fn shape(name: &str, text: &str) -> Result<[usize; 3], JudgeError> {
    let number = |side: &str| {
        let is_number = side.len() <= 5 && side.bytes().all(|byte| byte.is_ascii_digit());
        side.parse::<usize>().ok().filter(|_| is_number)
    };
    let sides = text.trim_end();
    let sides = sides.strip_suffix(',').unwrap_or(sides).split(',');
    let sides: Option<Vec<usize>> = sides.map(|side| number(side.trim())).collect();
    let size = match sides.as_deref() {
        Some(&[height, width]) => [height, width, 1],
        Some(&[height, width, lanes]) => [height, width, lanes],
        _ => [0; 3],
    };
    let [height, width, lanes] = size;
    let is_side = |side| (1..=LONGEST_SIDE).contains(&side);
    if is_side(height) && is_side(width) && (1..=4).contains(&lanes) {
        return Ok(size);
    }
    fail(format!(
        "{name}: has the shape ({text}), which is no picture: height, width and 1 to 4 lanes"
    ))
}

/// The numbers in little-endian data; those of 16-bit floats get 32 bits.
fn numbers(kind: &str, data: &[u8]) -> Samples {
    match kind {
        "|u1" => Samples::U8(data.to_vec()),
        "<u2" => Samples::U16(each(data, u16::from_le_bytes)),
        "<f2" => Samples::F32(each(data, |bytes| half(u16::from_le_bytes(bytes)))),
        "<f4" => Samples::F32(each(data, f32::from_le_bytes)),
        _ => Samples::F64(each(data, f64::from_le_bytes)),
    }
}

/// A number of each `SIZE` bytes.
fn each<T, const SIZE: usize>(data: &[u8], number: impl Fn([u8; SIZE]) -> T) -> Vec<T> {
    data.chunks_exact(SIZE)
        .filter_map(|bytes| bytes.try_into().ok())
        .map(number)
        .collect()
}

/// The value of a 16-bit float.
fn half(bits: u16) -> f32 {
    let fraction = f32::from(bits & 0x3ff);
    let magnitude = match bits >> 10 & 0x1f {
        0 => fraction * 2f32.powi(-24),
        31 if fraction == 0.0 => f32::INFINITY,
        31 => f32::NAN,
        exponent => (fraction + 1024.0) * 2f32.powi(i32::from(exponent) - 25),
    };
    if bits >> 15 == 0 {
        magnitude
    } else {
        -magnitude
    }
}

/// The command line. The exit code is 0 for a good picture, 1 for a bad one, and 2 for an error.
pub fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    let (folder, output, path, encoding) = match arguments[..] {
        [folder, output, path] | [folder, output, path, "linear"] => {
            (folder, output, path, Encoding::Linear)
        }
        [folder, output, path, "srgb"] => (folder, output, path, Encoding::Srgb),
        _ => {
            eprintln!("usage: burnish_judge FOLDER OUTPUT PICTURE.npy [linear|srgb]");
            return ExitCode::from(2);
        }
    };
    let verdict = Bounds::load(folder, output)
        .and_then(|bounds| judge(&bounds, &Picture::load(path)?, encoding));
    match verdict {
        Ok(verdict) => {
            println!("{verdict}");
            ExitCode::from(u8::from(!verdict.is_good()))
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
