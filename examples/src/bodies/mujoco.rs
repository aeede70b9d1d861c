//! The same boxes in `MuJoCo`, where its Python package is there.

use std::process::Command;

/// What the script ends with where there is no such package.
const ABSENT: i32 = 3;

/// What `MuJoCo` takes, or why that is not known.
#[derive(Clone, Debug, PartialEq)]
pub enum Rival {
    /// Processor time of a step, ms.
    Step(f64),
    /// There is no Python, or it has no such package.
    Absent,
    /// It was there and did not do it: what it said last.
    Failed(String),
}

/// A step of boxes of half a metre that fall on one another, in the mean of so many steps from the start, in `MuJoCo`.
pub fn mujoco_boxes(count: usize, steps: usize) -> Rival {
    let script = ["-c", include_str!("boxes_in_mujoco.py")].map(str::to_owned);
    let run = Command::new("python3").args(script).args([count.to_string(), steps.to_string()]).output();
    let Ok(output) = run else { return Rival::Absent };
    if output.status.code() == Some(ABSENT) {
        return Rival::Absent;
    }
    let said = String::from_utf8_lossy(&output.stdout);
    match said.trim().parse() {
        Ok(step) if output.status.success() => Rival::Step(step),
        _ => {
            let complaint = String::from_utf8_lossy(&output.stderr);
            Rival::Failed(complaint.lines().last().unwrap_or("nothing").to_owned())
        }
    }
}
