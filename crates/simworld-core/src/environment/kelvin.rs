//! The colour of glowing bodies: from a temperature to linear-light sRGB.

/// CIE 1931 chromaticity of a black body, for 1667 to 25 000 K; what lies outside is taken at the nearer end.
///
/// Y. Kim et al., Design of advanced color temperature control system for HDTV applications, Journal of the Korean Physical
/// Society 41 (2002) 865-871: cubic splines of the Planckian locus.
pub fn black_body_chromaticity(kelvin: f64) -> [f64; 2] {
    let t = if kelvin.is_nan() { 6500.0 } else { kelvin.clamp(1667.0, 25_000.0) };
    let (t1, t2, t3) = (1e3 / t, 1e6 / (t * t), 1e9 / (t * t * t));
    let x = if t <= 4000.0 {
        -0.266_123_9 * t3 - 0.234_358_9 * t2 + 0.877_695_6 * t1 + 0.179_910
    } else {
        -3.025_846_9 * t3 + 2.107_037_9 * t2 + 0.222_634_7 * t1 + 0.240_390
    };
    let (x2, x3) = (x * x, x * x * x);
    let y = if t <= 2222.0 {
        -1.106_381_4 * x3 - 1.348_110_20 * x2 + 2.185_558_32 * x - 0.202_196_83
    } else if t <= 4000.0 {
        -0.954_947_6 * x3 - 1.374_185_93 * x2 + 2.091_370_15 * x - 0.167_488_67
    } else {
        3.081_758_0 * x3 - 5.873_386_70 * x2 + 3.751_129_97 * x - 0.370_014_83
    };
    [x, y]
}

/// The colour of a lamp of a correlated colour temperature: linear-light sRGB of luminance one. What lies outside of sRGB
/// is cut off at zero.
///
/// ```
/// use simworld_core::environment::color_of_kelvin;
/// let [r, g, b] = color_of_kelvin(2700.0);
/// assert!(r > 2.0 * g && g > 2.0 * b);
/// ```
pub fn color_of_kelvin(kelvin: f64) -> [f64; 3] {
    let [x, y] = black_body_chromaticity(kelvin);
    let (big_x, big_z) = (x / y, (1.0 - x - y) / y);
    // IEC 61966-2-1: from XYZ to linear sRGB.
    let color = [
        3.240_625_5 * big_x - 1.537_208_0 - 0.498_628_6 * big_z,
        -0.968_930_7 * big_x + 1.875_756_1 + 0.041_517_5 * big_z,
        0.055_710_1 * big_x - 0.204_021_1 + 1.056_995_9 * big_z,
    ]
    .map(|channel| channel.max(0.0));
    let luminance = 0.2126 * color[0] + 0.7152 * color[1] + 0.0722 * color[2];
    color.map(|channel| channel / luminance)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn u_v([x, y]: [f64; 2]) -> [f64; 2] {
        let below = -2.0 * x + 12.0 * y + 3.0;
        [4.0 * x / below, 9.0 * y / below]
    }

    fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
        let ([u, v], [s, t]) = (u_v(a), u_v(b));
        ((u - s) * (u - s) + (v - t) * (v - t)).sqrt()
    }

    /// Chromaticities of black bodies: illuminant A at 2856 K (0.447 58, 0.407 45) and, by the tables of Wyszecki and Stiles,
    /// 6500 K (0.3135, 0.3237) and 10 000 K (0.2807, 0.2884).
    #[test]
    fn the_locus_runs_through_the_tables() {
        for (kelvin, known) in
            [(2856.0, [0.447_58, 0.407_45]), (6500.0, [0.3135, 0.3237]), (10_000.0, [0.2807, 0.2884])]
        {
            let off = apart(black_body_chromaticity(kelvin), known);
            assert!(off < 0.001, "{kelvin} K is {off} off");
        }
    }

    /// D65 is daylight, which lies 0.003 beside the locus of black bodies.
    #[test]
    fn six_and_a_half_thousand_kelvin_are_white() {
        assert!(apart(black_body_chromaticity(6500.0), [0.312_7, 0.329_0]) < 0.006);
        let [r, g, b] = color_of_kelvin(6500.0);
        assert!([r, g, b].iter().all(|channel| (channel - 1.0).abs() < 0.08), "{r} {g} {b}");
    }

    #[test]
    fn no_temperature_breaks_the_colour() {
        for kelvin in [f64::NEG_INFINITY, -5.0, 0.0, 1667.0, 4000.0, 1e9, f64::INFINITY, f64::NAN] {
            assert!(color_of_kelvin(kelvin).iter().all(|c| c.is_finite() && *c >= 0.0), "{kelvin}");
        }
    }
}
