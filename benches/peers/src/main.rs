//! PolyScene beside rapier3d on the same scenes: time against error, in one run.
//!
//! Prints a table and the claims it checks, and writes every point to a CSV file.
//! Usage: `cargo run --release [--quick] [--case TEXT] [--csv FILE]`. For other programs: `--write FOLDER` writes the
//! scenes as files instead, `--states FILE` measures the states that another program came to in the one chosen.

#![allow(clippy::print_stdout, reason = "a program that prints figures")]

mod cases;
mod engines;
mod ours;
mod peer;
mod recorded;
mod reference;
mod report;
mod run;
#[path = "../../scenes/mod.rs"]
mod scenes;

use std::error::Error;
use std::path::{Path, PathBuf};

use polyscene::scene::{Document, NumberStyle};

use crate::cases::Case;
use crate::recorded::Recorded;

fn main() -> Result<(), Box<dyn Error>> {
    let mut csv = PathBuf::from("peers.csv");
    let (mut write, mut states) = (None, None);
    let mut quick = false;
    let mut wanted = String::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--quick" => quick = true,
            "--csv" => csv = arguments.next().ok_or("--csv needs a file name")?.into(),
            "--write" => write = Some(PathBuf::from(arguments.next().ok_or("--write needs a folder")?)),
            "--states" => states = Some(PathBuf::from(arguments.next().ok_or("--states needs a file name")?)),
            "--case" => wanted = arguments.next().ok_or("--case needs a part of a name")?,
            other => return Err(format!("unknown argument {other}; see benches/peers/README.md").into()),
        }
    }
    let chosen: Vec<Case> = cases::all()?.into_iter().filter(|case| case.name.contains(&wanted)).collect();
    if let Some(folder) = write {
        return chosen.iter().try_for_each(|case| write_scene(case, &folder));
    }
    if let (Some(path), Some(case)) = (states, chosen.first()) {
        report::recorded(case, &run::watched(case, &mut Recorded::read(&path)?));
        return Ok(());
    }
    let mut points = Vec::new();
    report::head();
    for case in chosen {
        let of_case = run::measure(&case, quick);
        report::table(&case, &of_case);
        points.extend(of_case);
    }
    report::write_csv(&csv, &points)?;
    println!("\nevery point is in {}", csv.display());
    if report::claims(&points) { Ok(()) } else { Err("a claim does not hold".into()) }
}

fn write_scene(case: &Case, folder: &Path) -> Result<(), Box<dyn Error>> {
    let path = folder.join(format!("{}.xml", case.name.replace([' ', ',', '/'], "-")));
    Document::of_scene(&case.scene, NumberStyle::Point)?.save(&path)?;
    println!("{}", path.display());
    Ok(())
}
