//! Which instruction sets this machine can compare, and whether none is left out by mistake.

use std::io::Write;

use crate::deform::SimdLevel;

/// Returns the levels to be compared with the scalar twin: all others that this CPU has.
pub fn levels() -> Vec<SimdLevel> {
    SimdLevel::ALL.into_iter().filter(|&level| level != SimdLevel::Scalar && level.is_available()).collect()
}

/// Returns the features of this CPU as the system names them, or `None` where it does not say.
fn features() -> Option<Vec<String>> {
    let text = std::fs::read_to_string("/proc/cpuinfo").ok()?;
    let line = text.lines().find(|line| line.starts_with("flags") || line.starts_with("Features"))?;
    Some(line.split_whitespace().map(str::to_owned).collect())
}

/// Compares the levels with what the operating system says of the CPU, which does not ask our code. Names those that no
/// test on this machine compares, past the capture of output: a log must show what it does not prove.
#[test]
fn every_instruction_set_of_this_machine_is_compared() {
    let compared = levels();
    for level in SimdLevel::ALL.into_iter().filter(|level| !level.is_available()) {
        let _ = writeln!(std::io::stderr(), "NOT COMPARED: this machine has no {}", level.name());
    }
    let Some(features) = features() else {
        assert!(std::env::var_os("CI").is_none() || !cfg!(target_os = "linux"), "the system names no features");
        return;
    };
    let has = |names: &[&str]| names.iter().all(|name| features.iter().any(|feature| feature == name));
    let expected = [
        (SimdLevel::Neon, has(&["asimd"])),
        (SimdLevel::Sse2, has(&["sse2"])),
        (SimdLevel::Avx2, has(&["avx2"])),
        (SimdLevel::Avx512, has(&["avx512f", "avx512vl"])),
    ];
    for (level, here) in expected {
        assert_eq!(compared.contains(&level), here, "{}", level.name());
    }
}
