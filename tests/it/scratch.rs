//! scratch
use crate::common::drive::simulation;
use crate::sim_random::{Contents, random_scene};
#[test]
fn scratch() {
    for (contents, seeds) in [(Contents::Lossy, 200..220), (Contents::Everything, 300..320)] {
        for seed in seeds {
            let scene = random_scene(seed, contents);
            let start = std::time::Instant::now();
            let mut sim = simulation(&scene);
            let mut t = 0.0;
            let mut n = 0;
            let end = if contents == Contents::Lossy { 8.0 } else { 5.0 };
            'run: while t < end {
                t += 0.1;
                sim.begin(t);
                loop {
                    match sim.next_event() {
                        Ok(Some(event)) => {
                            n += 1;
                            if std::env::var("SEED").is_ok_and(|s| s == seed.to_string()) {
                                eprintln!(
                                    "{} {:.12} {:?} {:?} {:?} J {:.3e} {:.3e}->{:.3e} g{}",
                                    event.seq,
                                    event.time,
                                    event.kind,
                                    event.a,
                                    event.b,
                                    event.impulse,
                                    event.vn_before,
                                    event.vn_after,
                                    event.group
                                );
                            }
                            if n % 1000 == 0 && start.elapsed().as_secs_f64() > 10.0 {
                                break 'run;
                            }
                        }
                        Ok(None) => break,
                        Err(fault) => {
                            eprintln!("{contents:?} {seed} FAULT {fault}");
                            break 'run;
                        }
                    }
                }
                if start.elapsed().as_secs_f64() > 10.0 {
                    break;
                }
            }
            eprintln!(
                "{contents:?} {seed} t {:.3} n {n} {:.2} s {:?}",
                sim.time(),
                start.elapsed().as_secs_f64(),
                sim.counters()
            );
        }
    }
}
