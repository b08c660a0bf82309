//! PolyScene beside rapier3d on the same scenes: time against error, in one run.
//!
//! Prints a table and the claims it checks, and writes every point to a CSV file.
//! Usage: `cargo run --release [--quick] [--case TEXT] [--csv FILE]`.

#![allow(clippy::print_stdout, reason = "a program that prints figures")]

mod cases;
mod engines;
mod ours;
mod peer;
mod reference;
mod report;
mod run;
#[path = "../../scenes/mod.rs"]
mod scenes;

use std::error::Error;
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn Error>> {
    let mut csv = PathBuf::from("peers.csv");
    let mut quick = false;
    let mut wanted = String::new();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--quick" => quick = true,
            "--csv" => csv = arguments.next().ok_or("--csv needs a file name")?.into(),
            "--case" => wanted = arguments.next().ok_or("--case needs a part of a name")?,
            other => return Err(format!("unknown argument {other}; see benches/peers/README.md").into()),
        }
    }
    let mut points = Vec::new();
    report::head();
    for case in cases::all()?.into_iter().filter(|case| case.name.contains(&wanted)) {
        let of_case = run::measure(&case, quick);
        report::table(&case, &of_case);
        points.extend(of_case);
    }
    report::write_csv(&csv, &points)?;
    println!("\nevery point is in {}", csv.display());
    if report::claims(&points) { Ok(()) } else { Err("a claim does not hold".into()) }
}
