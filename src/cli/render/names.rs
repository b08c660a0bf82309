//! The files of numbered pictures: a pattern such as `frame-%05d.png`, or a folder of them.

use std::path::{MAIN_SEPARATOR, Path, PathBuf};

/// Of pictures in a folder; what ffmpeg and Blender find by themselves.
const USUAL: &str = "frame-%05d.png";

/// Digits that a number is filled up to at most.
const MOST_DIGITS: usize = 9;

/// A file for each number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Names {
    pub folder: PathBuf,
    before: String,
    digits: usize,
    after: String,
}

impl Names {
    /// `output` is a folder (there already, or ending in a slash) or a path whose file name has one place for a number:
    /// `%d`, or `%05d` filled up with zeros; `%%` is a percent sign. The error says what is missing.
    pub fn of(output: &Path) -> Result<Self, String> {
        let is_folder = output.is_dir() || output.to_string_lossy().ends_with(['/', MAIN_SEPARATOR]);
        if is_folder {
            return Self::in_folder(output, USUAL);
        }
        let folder = output.parent().unwrap_or(Path::new(""));
        let name = output.file_name().and_then(|name| name.to_str());
        Self::in_folder(folder, name.ok_or("the name of a picture must be text")?)
    }

    fn in_folder(folder: &Path, pattern: &str) -> Result<Self, String> {
        let wanted = || {
            format!(
                "several pictures need a folder that is there, or a name with one place for a number such as {USUAL}: {pattern}"
            )
        };
        let (mut before, mut after, mut digits) = (String::new(), None::<String>, 0);
        let mut rest = pattern;
        while let Some((text, code)) = rest.split_once('%') {
            let part = after.as_mut().unwrap_or(&mut before);
            part.push_str(text);
            if let Some(next) = code.strip_prefix('%') {
                part.push('%');
                rest = next;
                continue;
            }
            let (filled, next) = code.split_once('d').filter(|_| after.is_none()).ok_or_else(wanted)?;
            digits = match filled.strip_prefix('0').map(str::parse) {
                None if filled.is_empty() => 1,
                Some(Ok(digits)) if (1..=MOST_DIGITS).contains(&digits) => digits,
                _ => return Err(wanted()),
            };
            (after, rest) = (Some(String::new()), next);
        }
        let after = after.ok_or_else(wanted)? + rest;
        Ok(Self { folder: folder.into(), before, digits, after })
    }

    pub fn at(&self, number: usize) -> PathBuf {
        let Self { folder, before, digits, after } = self;
        folder.join(format!("{before}{number:0digits$}{after}"))
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test fails by stopping")]

    use super::*;

    #[test]
    fn a_number_is_filled_up_to_its_digits() {
        let name = |pattern: &str, number| Names::of(Path::new(pattern)).unwrap().at(number);
        assert_eq!(name("frame-%05d.png", 7), Path::new("frame-00007.png"));
        assert_eq!(name("there/%d.png", 12), Path::new("there/12.png"));
        assert_eq!(name("50%%-%02d%%.png", 3), Path::new("50%-03%.png"));
        assert_eq!(name("%03d", 12_345), Path::new("12345"));
        assert_eq!(name("new/", 0), Path::new("new/frame-00000.png"));
        assert_eq!(name("src", 1), Path::new("src/frame-00001.png"), "a folder that is there");
    }

    #[test]
    fn a_name_without_one_place_for_a_number_is_refused() {
        for pattern in
            ["frame.png", "%d-%d.png", "%5d.png", "%0d.png", "%099d.png", "%s.png", "100%", "%%d.png"]
        {
            let refusal = Names::of(Path::new(pattern)).unwrap_err();
            assert!(refusal.contains("frame-%05d.png") && refusal.contains(pattern), "{refusal}");
        }
    }
}
