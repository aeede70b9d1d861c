//! On which side of the road a country drives.

use simworld_core::geometry::Point2;

use super::place::Place;
use super::street;
use super::tags::Key;

/// Whether traffic keeps left: as tags say, or as its roundabouts turn, or as the country does.
pub(super) fn is_left_hand(place: &Place) -> bool {
    let (mut left, mut right) = (0_usize, 0_usize);
    for way in place.raw.ways() {
        let tags = place.raw.way_tags(way);
        if !street::is_street(&tags) {
            continue;
        }
        match tags.get(Key::DrivingSide) {
            Some("left") => left += 1,
            Some("right") => right += 1,
            _ => {}
        }
        if tags.is_any(Key::Junction, &["roundabout", "circular"]) {
            let ring: Vec<Point2> =
                place.raw.nodes_of(way).iter().filter_map(|node| place.point(*node)).collect();
            let turned = turning(&ring);
            // Clockwise round the middle where people keep left.
            left += usize::from(turned < 0.0);
            right += usize::from(turned > 0.0);
        }
    }
    if left == right {
        is_left_hand_country(place.origin.longitude, place.origin.latitude)
    } else {
        left > right
    }
}

/// Twice the area to the left of an arc and its chord: positive if it turns left.
fn turning(ring: &[Point2]) -> f64 {
    let Some(first) = ring.first() else { return 0.0 };
    ring.windows(2).map(|pair| (pair[0] - first).perp(&(pair[1] - first))).sum()
}

/// West, south, east and north of the parts of the world that drive on the left, degrees; coarse at land borders,
/// where roundabouts and tags say more. List of countries: <https://en.wikipedia.org/wiki/Left-_and_right-hand_traffic>.
const LEFT_HAND: [[f64; 4]; 29] = [
    // British Isles; the Channel coast of France lies south-east of it
    [-11.0, 49.9, -1.8, 61.0],
    [-1.8, 50.4, 1.85, 61.0],
    // Channel Islands, Malta, Cyprus
    [-2.75, 49.1, -2.0, 49.8],
    [14.1, 35.7, 14.7, 36.1],
    [32.2, 34.5, 34.7, 35.8],
    // India, Pakistan, Nepal, Bhutan, Bangladesh, Sri Lanka, Maldives
    [61.5, 24.6, 71.0, 30.0],
    [66.5, 30.0, 78.5, 36.5],
    [68.0, 5.5, 92.0, 30.0],
    [72.5, -0.8, 73.8, 7.2],
    // Thailand, Malaysia, Singapore, Brunei, Indonesia, Timor, Papua New Guinea
    [97.4, 5.6, 102.0, 20.0],
    [102.0, 11.5, 104.5, 17.8],
    [95.0, -11.2, 141.0, 7.4],
    [140.9, -12.0, 156.0, -0.8],
    // Hong Kong, Macau, Japan
    [113.8, 22.15, 114.5, 22.56],
    [113.5, 22.1, 113.6, 22.22],
    [127.0, 24.0, 146.0, 34.2],
    [129.5, 34.2, 146.0, 45.6],
    // Australia, New Zealand, islands of the South Pacific
    [112.0, -45.0, 154.5, -9.9],
    [165.0, -48.0, 179.99, -34.0],
    [159.0, -22.0, 180.0, -5.0],
    [-176.5, -23.0, -157.0, -8.0],
    // South Africa to Zambia and Mozambique; Tanzania, Kenya, Uganda
    [11.7, -35.0, 41.0, -17.0],
    [22.0, -18.1, 36.0, -8.2],
    [30.0, -11.8, 42.0, -1.0],
    [29.6, -1.0, 41.9, 4.6],
    // Mauritius and Seychelles
    [55.2, -20.6, 64.0, -3.7],
    // Jamaica, the Bahamas, the eastern Caribbean, Guyana and Suriname
    [-78.5, 17.6, -76.1, 18.6],
    [-79.5, 20.9, -72.5, 27.4],
    [-61.6, 1.8, -54.0, 13.4],
];

fn is_left_hand_country(longitude: f64, latitude: f64) -> bool {
    let within = |[west, south, east, north]: &[f64; 4]| {
        (*west..=*east).contains(&longitude) && (*south..=*north).contains(&latitude)
    };
    LEFT_HAND.iter().any(within)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cities_drive_on_their_side() {
        let left = [
            ("London", -0.13, 51.5),
            ("Leeds", -1.54, 53.8),
            ("Dublin", -6.26, 53.35),
            ("Nicosia", 33.38, 35.18),
            ("Mumbai", 72.88, 19.08),
            ("Karachi", 67.0, 24.86),
            ("Bangkok", 100.5, 13.75),
            ("Singapore", 103.8, 1.35),
            ("Jakarta", 106.8, -6.2),
            ("Hong Kong", 114.17, 22.3),
            ("Tokyo", 139.7, 35.7),
            ("Sydney", 151.2, -33.9),
            ("Auckland", 174.76, -36.85),
            ("Cape Town", 18.42, -33.9),
            ("Nairobi", 36.8, -1.29),
            ("Kampala", 32.58, 0.32),
            ("Kingston", -76.8, 17.98),
        ];
        let right = [
            ("Monaco", 7.42, 43.74),
            ("Helsinki", 24.94, 60.17),
            ("Berlin", 13.4, 52.5),
            ("Paris", 2.35, 48.86),
            ("Calais", 1.86, 50.95),
            ("Campo Grande", -54.6, -20.5),
            ("Seattle", -122.3, 47.6),
            ("Beijing", 116.4, 39.9),
            ("Shenzhen", 114.06, 22.6),
            ("Seoul", 127.0, 37.57),
            ("Manila", 121.0, 14.6),
            ("Hanoi", 105.85, 21.03),
            ("Cairo", 31.2, 30.0),
            ("Lagos", 3.4, 6.5),
            ("Miami", -80.2, 25.8),
        ];
        for (city, longitude, latitude) in left {
            assert!(is_left_hand_country(longitude, latitude), "{city}");
        }
        for (city, longitude, latitude) in right {
            assert!(!is_left_hand_country(longitude, latitude), "{city}");
        }
    }

    #[test]
    fn a_ring_turns_the_way_it_is_drawn() {
        let square =
            [(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (0.0, 0.0)].map(|(x, y)| Point2::new(x, y));
        assert!(turning(&square) > 0.0);
        let mut back = square;
        back.reverse();
        assert!(turning(&back) < 0.0);
    }
}
