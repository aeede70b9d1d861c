//! Tags: the keys that mean something here, and their values in one piece of text.
//!
//! An extract has hundreds of keys; only those below are kept. A value is a range of one long string, so that reading
//! allocates nothing for each element.

/// Declares the keys with their names in OpenStreetMap.
macro_rules! keys {
    ($($variant:ident = $name:literal,)+) => {
        /// A key that means something here.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        #[repr(u8)]
        pub(super) enum Key {
            $($variant,)+
        }

        impl Key {
            /// The key of that name, if it means something here.
            pub(super) fn from_name(name: &[u8]) -> Option<Self> {
                const NAMES: &[(&[u8], Key)] = &[$(($name.as_bytes(), Key::$variant),)+];
                // By length and first byte: a few candidates are left.
                const STARTS: [u8; 256] = starts(NAMES);
                let first = *name.first()?;
                let mut index = usize::from(STARTS[usize::from(first)]);
                while let Some((known, key)) = NAMES.get(index).filter(|(known, _)| known[0] == first) {
                    if *known == name {
                        return Some(*key);
                    }
                    index += 1;
                }
                None
            }
        }
    };
}

/// Where the names of each first byte begin; the names are in groups by it.
const fn starts(names: &[(&[u8], Key)]) -> [u8; 256] {
    let mut starts = [u8::MAX; 256];
    let mut index = names.len();
    while index > 0 {
        index -= 1;
        starts[names[index].0[0] as usize] = index as u8;
    }
    starts
}

keys! {
    Access = "access",
    Amenity = "amenity",
    Area = "area",
    Bridge = "bridge",
    Building = "building",
    BuildingLevels = "building:levels",
    BuildingPart = "building:part",
    Busway = "busway",
    Covered = "covered",
    Crossing = "crossing",
    Cycleway = "cycleway",
    CyclewayBoth = "cycleway:both",
    CyclewayLeft = "cycleway:left",
    CyclewayRight = "cycleway:right",
    DrivingSide = "driving_side",
    Emergency = "emergency",
    Except = "except",
    Foot = "foot",
    Footway = "footway",
    Healthcare = "healthcare",
    Height = "height",
    Highway = "highway",
    Indoor = "indoor",
    Junction = "junction",
    Landuse = "landuse",
    Lanes = "lanes",
    LanesBackward = "lanes:backward",
    LanesBus = "lanes:bus",
    LanesForward = "lanes:forward",
    LanesPsv = "lanes:psv",
    Layer = "layer",
    Leisure = "leisure",
    Location = "location",
    ManMade = "man_made",
    MaxSpeed = "maxspeed",
    MotorVehicle = "motor_vehicle",
    MotorCar = "motorcar",
    Name = "name",
    Natural = "natural",
    Office = "office",
    OneWay = "oneway",
    ParkingBoth = "parking:both",
    ParkingLaneBoth = "parking:lane:both",
    ParkingLaneLeft = "parking:lane:left",
    ParkingLaneRight = "parking:lane:right",
    ParkingLeft = "parking:left",
    ParkingRight = "parking:right",
    Place = "place",
    Restriction = "restriction",
    RoofShape = "roof:shape",
    Service = "service",
    Shop = "shop",
    Sidewalk = "sidewalk",
    SidewalkBoth = "sidewalk:both",
    SidewalkLeft = "sidewalk:left",
    SidewalkRight = "sidewalk:right",
    Tourism = "tourism",
    Tunnel = "tunnel",
    TurnLanes = "turn:lanes",
    TurnLanesBackward = "turn:lanes:backward",
    TurnLanesForward = "turn:lanes:forward",
    Type = "type",
    Vehicle = "vehicle",
    Waterway = "waterway",
    Width = "width",
}

/// The tags of one element: a range of the tags of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct TagRange {
    pub(super) start: u32,
    pub(super) count: u32,
}

/// The tags of all elements.
#[derive(Clone, Debug, Default)]
pub(super) struct TagStore {
    /// Key, and where its value begins and ends in the text.
    entries: Vec<(Key, u32, u32)>,
    text: String,
}

/// Bytes of text that are kept at most; an extract of a large country has less.
const MOST_TEXT: usize = 1 << 30;

impl TagStore {
    /// The number of tags so far: where those of the next element begin.
    pub(super) fn mark(&self) -> u32 {
        self.entries.len() as u32
    }

    /// The tags since a mark.
    pub(super) fn since(&self, mark: u32) -> TagRange {
        TagRange { start: mark, count: self.mark() - mark }
    }

    /// Keeps a tag, or says that there is no more room.
    pub(super) fn push(&mut self, key: Key, value: &str) -> bool {
        let start = self.text.len();
        if start + value.len() > MOST_TEXT {
            return false;
        }
        self.text.push_str(value);
        self.entries.push((key, start as u32, self.text.len() as u32));
        true
    }

    /// The tags of an element.
    pub(super) fn of(&self, range: TagRange) -> Tags<'_> {
        let entries = &self.entries[range.start as usize..(range.start + range.count) as usize];
        Tags { entries, text: &self.text }
    }
}

/// The tags of one element.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tags<'a> {
    entries: &'a [(Key, u32, u32)],
    text: &'a str,
}

impl<'a> Tags<'a> {
    /// The value of a key; the first, where a key stands twice.
    pub(super) fn get(&self, key: Key) -> Option<&'a str> {
        let (_, start, end) = self.entries.iter().find(|(known, _, _)| *known == key)?;
        Some(self.text[*start as usize..*end as usize].trim())
    }

    /// Whether a key has that value.
    pub(super) fn is(&self, key: Key, value: &str) -> bool {
        self.get(key) == Some(value)
    }

    /// Whether a key has one of these values.
    pub(super) fn is_any(&self, key: Key, values: &[&str]) -> bool {
        self.get(key).is_some_and(|value| values.contains(&value))
    }

    /// Whether a key stands there with another value than `no`.
    pub(super) fn has(&self, key: Key) -> bool {
        self.get(key).is_some_and(|value| value != "no" && !value.is_empty())
    }

    /// Whether nothing but this key says something.
    pub(super) fn is_alone(&self, key: Key) -> bool {
        self.entries.iter().all(|(known, ..)| *known == key)
    }

    /// A whole number; the first of a list such as `2;3`.
    pub(super) fn count(&self, key: Key) -> Option<u32> {
        let first = self.get(key)?.split([';', ',', '|', '-']).next()?.trim();
        let number: f64 = first.parse().ok()?;
        (0.0..1e4).contains(&number).then_some(number as u32)
    }

    /// A length, m: `7`, `7.5 m`, `24'`, `24 ft`, `7,5`.
    pub(super) fn metres(&self, key: Key) -> Option<f64> {
        metres(self.get(key)?)
    }
}

/// A length as people write it, m.
fn metres(text: &str) -> Option<f64> {
    const FOOT: f64 = 0.3048;
    let text = text.split(';').next()?.trim();
    if let Some((feet, inches)) = text.split_once('\'') {
        let feet: f64 = feet.trim().parse().ok()?;
        let inches: f64 = inches.trim().trim_end_matches('"').parse().unwrap_or(0.0);
        return positive((feet + inches / 12.0) * FOOT);
    }
    let (number, unit) = match text.strip_suffix("ft") {
        Some(number) => (number, FOOT),
        None => (text.strip_suffix('m').unwrap_or(text), 1.0),
    };
    let number: f64 = number.trim().replace(',', ".").parse().ok()?;
    positive(number * unit)
}

fn positive(x: f64) -> Option<f64> {
    (x > 0.0 && x < 1e5).then_some(x)
}

/// A speed as people write it, m/s: `50`, `30 mph`; none for `signals` and words for the law of a country.
pub(super) fn speed(text: &str) -> Option<f64> {
    let text = text.split(';').next()?.trim();
    let (number, unit) = match (text.strip_suffix("mph"), text.strip_suffix("knots")) {
        (Some(number), _) => (number, 0.447_04),
        (_, Some(number)) => (number, 0.514_444),
        _ => (text.strip_suffix("km/h").unwrap_or(text), 1.0 / 3.6),
    };
    let metres_a_second = number.trim().parse::<f64>().ok()? * unit;
    (1.0..=70.0).contains(&metres_a_second).then_some(metres_a_second)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_found_by_name() {
        assert_eq!(Key::from_name(b"highway"), Some(Key::Highway));
        assert_eq!(Key::from_name(b"access"), Some(Key::Access));
        assert_eq!(Key::from_name(b"width"), Some(Key::Width));
        assert_eq!(Key::from_name(b"turn:lanes:forward"), Some(Key::TurnLanesForward));
        for unknown in [&b""[..], b"highwa", b"highways", b"zebra", b"a", b"\xff"] {
            assert_eq!(Key::from_name(unknown), None);
        }
    }

    #[test]
    fn numbers_are_read_as_people_write_them() {
        let near = |found: Option<f64>, expected: f64| (found.unwrap() - expected).abs() < 1e-3;
        assert!(near(metres("7.5"), 7.5) && near(metres("7,5 m"), 7.5) && near(metres("24'"), 7.315));
        assert!(near(metres("10'6\""), 3.2004) && near(metres("24 ft"), 7.315));
        assert!(near(speed("30 mph"), 13.411) && near(speed("50"), 13.889) && near(speed("50 km/h"), 13.889));
        for nonsense in ["", "wide", "-3", "NaN", "inf", "1e300", "'"] {
            assert_eq!(metres(nonsense), None, "{nonsense}");
            assert_eq!(speed(nonsense), None, "{nonsense}");
        }
        assert_eq!(speed("signals"), None);
    }

    #[test]
    fn values_are_those_of_their_element() {
        let mut store = TagStore::default();
        store.push(Key::Name, "elsewhere");
        let mark = store.mark();
        store.push(Key::Lanes, "2;3");
        store.push(Key::OneWay, "no");
        let range = store.since(mark);
        let tags = store.of(range);
        assert_eq!((tags.get(Key::Name), tags.count(Key::Lanes)), (None, Some(2)));
        assert!(!tags.has(Key::OneWay) && tags.is(Key::OneWay, "no"));
    }
}
