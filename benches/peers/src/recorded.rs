//! The states that another program wrote down: a line of a CSV file for each time, `t` and then `x y z vx vy vz` of
//! each sphere in the order of the UserIDs.

use std::error::Error;
use std::path::Path;

use glam::DVec3;

use crate::engines::{Ball, World};

pub struct Recorded {
    rows: Vec<Vec<f64>>,
    at: usize,
}

impl Recorded {
    pub fn read(path: &Path) -> Result<Self, Box<dyn Error>> {
        let text = std::fs::read_to_string(path)?;
        let rows: Result<Vec<Vec<f64>>, _> =
            text.lines().map(|line| line.split(',').map(str::parse).collect()).collect();
        let rows = rows?;
        if rows.is_empty() { Err("no states in it".into()) } else { Ok(Self { rows, at: 0 }) }
    }
}

impl World for Recorded {
    fn advance(&mut self, time: f64) -> bool {
        while self.time() < time - 1e-6 && self.at + 1 < self.rows.len() {
            self.at += 1;
        }
        self.time() >= time - 1e-6
    }

    fn time(&self) -> f64 {
        self.rows[self.at][0]
    }

    fn read(&self, into: &mut Vec<Ball>) {
        into.clear();
        into.extend(self.rows[self.at][1..].chunks_exact(6).map(|ball| Ball {
            position: DVec3::new(ball[0], ball[1], ball[2]),
            velocity: DVec3::new(ball[3], ball[4], ball[5]),
        }));
    }

    fn impacts(&self) -> Option<u64> {
        None
    }
}
