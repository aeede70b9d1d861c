//! The same boxes in `MuJoCo`, where its Python package is there.

use std::process::{Command, Output};

/// What the script ends with where there is no such package.
const ABSENT: i32 = 3;

/// What was measured in `MuJoCo`, or why it was not.
#[derive(Clone, Debug, PartialEq)]
pub enum Rival<T> {
    /// What was measured.
    Measured(T),
    /// There is no Python, or it has no such package.
    Absent,
    /// It was there and did not do it: what it said last.
    Failed(String),
}

/// Why a script that ended so did not do it, with what was noticed here of that.
pub(super) fn absent_or<T>(output: &Output, noticed: &str) -> Rival<T> {
    if output.status.code() == Some(ABSENT) {
        return Rival::Absent;
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    Rival::Failed(complaint.lines().last().unwrap_or(noticed).to_owned())
}

/// A step of boxes of half a metre that fall on one another, in the mean of so many steps from the start, in `MuJoCo`: processor
/// time, ms.
pub fn mujoco_boxes(count: usize, steps: usize) -> Rival<f64> {
    let script = ["-c", include_str!("boxes_in_mujoco.py")].map(str::to_owned);
    let run = Command::new("python3").args(script).args([count.to_string(), steps.to_string()]).output();
    let Ok(output) = run else { return Rival::Absent };
    match String::from_utf8_lossy(&output.stdout).trim().parse() {
        Ok(step) if output.status.success() => Rival::Measured(step),
        _ => absent_or(&output, "it told no number"),
    }
}
