//! Which way the beams of a scanner go.

use simworld_core::geometry::Vector3;
use simworld_core::ops;

use crate::RenderError;

/// The steepest beam that views of a quarter turn show, radians: 60°.
const STEEPEST: f64 = std::f64::consts::FRAC_PI_3;
/// The most beams of a table.
const MOST: usize = 4_000_000;

/// One beam of a scan, in the sensor's frame (x forward, y left, z up).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Beam {
    /// The row it belongs to; rows of the tables made here are counted from the lowest.
    pub ring: u16,
    /// Radians counter-clockwise from forward.
    pub azimuth: f64,
    /// Radians above the horizon.
    pub elevation: f64,
}

impl Beam {
    /// Its direction, unit length, in the sensor's frame.
    pub fn direction(&self) -> Vector3 {
        let ((sin, cos), (up, flat)) = (ops::sin_cos(self.azimuth), ops::sin_cos(self.elevation));
        Vector3::new(flat * cos, flat * sin, up)
    }
}

/// The beams of a scan, in the order in which they are fired.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamTable {
    beams: Vec<Beam>,
}

impl BeamTable {
    /// Any beams.
    ///
    /// # Errors
    /// No beams or more than four million, a number that is not finite, or an elevation beyond a right angle.
    pub fn new(beams: Vec<Beam>) -> Result<Self, RenderError> {
        let fail = |reason: String| Err(RenderError::Beams { reason });
        if beams.is_empty() || beams.len() > MOST {
            return fail(format!("{} beams: give 1 to {MOST}", beams.len()));
        }
        let is_sound = |beam: &Beam| {
            beam.azimuth.is_finite()
                && beam.azimuth.abs() <= 1e3
                && beam.elevation.abs() <= std::f64::consts::FRAC_PI_2
        };
        match beams.iter().position(|beam| !is_sound(beam)) {
            Some(index) => {
                let Beam { azimuth, elevation, .. } = beams[index];
                fail(format!(
                    "beam {index} has azimuth {azimuth} and elevation {elevation}: give finite radians, and elevations within ±90°"
                ))
            }
            None => Ok(Self { beams }),
        }
    }

    /// Checks that views can show all of the beams.
    pub(super) fn check_views(&self) -> Result<(), RenderError> {
        match self.beams.iter().position(|beam| beam.elevation.abs() > STEEPEST) {
            None => Ok(()),
            Some(index) => Err(RenderError::Beams {
                reason: format!(
                    "beam {index} has elevation {}, and views show beams within ±60° alone: have them cast, on an adapter that binds nine storage buffers a stage and by a renderer that is not to draw by triangles alone",
                    self.beams[index].elevation
                ),
            }),
        }
    }

    /// A scanner that turns once counter-clockwise, from straight back: rows at these elevations (radians, from the lowest), fired
    /// together at each of so many steps.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn rotating(elevations: &[f64], columns: u32) -> Result<Self, RenderError> {
        let step = std::f64::consts::TAU / f64::from(columns.max(1));
        let column = |index: u32| -std::f64::consts::PI + (f64::from(index) + 0.5) * step;
        if elevations.len().saturating_mul(columns as usize) > MOST || elevations.len() > 65_535 {
            return Err(RenderError::Beams {
                reason: format!("{} rows of {columns} columns: give at most {MOST} beams", elevations.len()),
            });
        }
        let beams = (0..columns).flat_map(|index| {
            let rows = elevations.iter().enumerate();
            rows.map(move |(ring, elevation)| Beam {
                ring: ring as u16,
                azimuth: column(index),
                elevation: *elevation,
            })
        });
        Self::new(beams.collect())
    }

    /// 16 rows from -15° to 15° in steps of 2° (Velodyne VLP-16, user manual 63-9243, table of vertical angles).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn rows_16(columns: u32) -> Result<Self, RenderError> {
        Self::rotating(&spread(-15.0, 15.0, 16), columns)
    }

    /// 32 rows from -30.67° to 10.67° in steps of 4/3° (Velodyne HDL-32E, user manual, table of the firing order).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn rows_32(columns: u32) -> Result<Self, RenderError> {
        Self::rotating(&spread(-30.67, 10.67, 32), columns)
    }

    /// 64 rows: the lower 32 from -24.33° to -8.83° in steps of 1/2°, the upper 32 from -8.33° to 2° in steps of 1/3° (Velodyne HDL-64E,
    /// nominal).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn rows_64(columns: u32) -> Result<Self, RenderError> {
        let mut rows = spread(-24.33, -8.83, 32);
        rows.extend(spread(-8.33, 2.0, 32));
        Self::rotating(&rows, columns)
    }

    /// 128 rows evenly from -22.5° to 22.5°, as scanners with a view of 45° nominally have (Ouster OS1-128).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn rows_128(columns: u32) -> Result<Self, RenderError> {
        Self::rotating(&spread(-22.5, 22.5, 128), columns)
    }

    /// A table from text, such as the calibration of one's own scanner: lines `ring,azimuth,elevation` in degrees, in the order in which
    /// they are fired. Empty lines, and those that begin with `#`, are passed over.
    ///
    /// # Errors
    /// A line that is none, with its number; and as [`new`](Self::new).
    pub fn from_csv(text: &str) -> Result<Self, RenderError> {
        let mut beams = Vec::new();
        for (number, line) in (1..).zip(text.lines()) {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let beam = read(line).ok_or_else(|| RenderError::Beams {
                reason: format!("line {number}: {line:?} is no beam: give ring,azimuth,elevation in degrees"),
            })?;
            beams.push(beam);
        }
        Self::new(beams)
    }

    /// The beams.
    pub fn beams(&self) -> &[Beam] {
        &self.beams
    }
}

fn read(line: &str) -> Option<Beam> {
    let mut fields = line.split(',').map(str::trim);
    let ring = fields.next()?.parse().ok()?;
    let mut angle = || fields.next()?.parse::<f64>().ok().map(f64::to_radians);
    let beam = Beam { ring, azimuth: angle()?, elevation: angle()? };
    fields.next().is_none().then_some(beam)
}

/// So many angles evenly from one to another, degrees in, radians out.
fn spread(low: f64, high: f64, count: u32) -> Vec<f64> {
    let step = (high - low) / f64::from(count - 1);
    (0..count).map(|index| (low + step * f64::from(index)).to_radians()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_have_the_published_angles() {
        let angles = |table: Result<BeamTable, RenderError>| -> Vec<f64> {
            let table = table.unwrap();
            table
                .beams()
                .iter()
                .take_while(|beam| beam.azimuth == table.beams()[0].azimuth)
                .map(|beam| beam.elevation.to_degrees())
                .collect()
        };
        let near = |a: f64, b: f64| (a - b).abs() < 0.01;
        let rows = angles(BeamTable::rows_16(8));
        assert!(rows.len() == 16 && near(rows[0], -15.0) && near(rows[8], 1.0));
        let rows = angles(BeamTable::rows_32(8));
        // Of the table of the manual.
        for (row, angle) in [(0, -30.67), (1, -29.33), (22, -1.33), (23, 0.0), (31, 10.67)] {
            assert!(near(rows[row], angle), "{row}: {}", rows[row]);
        }
        let rows = angles(BeamTable::rows_64(8));
        assert!(rows.len() == 64 && near(rows[31], -8.83) && near(rows[32], -8.33) && near(rows[63], 2.0));
        assert_eq!(angles(BeamTable::rows_128(8)).len(), 128);
        assert_eq!(BeamTable::rows_16(1800).unwrap().beams().len(), 28_800);
    }

    #[test]
    fn tables_are_read_and_faults_are_named() {
        let table = BeamTable::from_csv("# own\n0, 0.0, -10\n\n1,90,5.5\n").unwrap();
        assert_eq!(table.beams().len(), 2);
        let direction = table.beams()[1].direction();
        assert!((direction.y - ops::cos(5.5_f64.to_radians())).abs() < 1e-12 && direction.x.abs() < 1e-12);
        let reason = |text: &str| BeamTable::from_csv(text).unwrap_err().to_string();
        assert!(reason("0,0,0\nx,1,2").contains("line 2"));
        assert!(reason("0,0,0,7").contains("line 1"));
        assert!(reason("0,0,91").contains("within ±90°"));
        assert!(BeamTable::from_csv("0,0,60").unwrap().check_views().is_ok());
        let steep = BeamTable::from_csv("0,0,0\n0,0,-80").unwrap().check_views().unwrap_err();
        assert!(steep.to_string().contains("beam 1"), "{steep}");
        assert!(reason("0,NaN,0").contains("beam 0"));
        assert!(reason("").contains("give 1 to"));
        assert!(BeamTable::rotating(&vec![0.0; 4096], 4096).is_err());
    }
}
