//! A network as the file has it.

use std::io::BufRead;

use simworld_core::geometry::Point2;

use crate::sumo::SumoError;
use crate::sumo::xml::{self, Element, Line, Visit};

/// Things of a kind that are read at most: their numbers are of 32 bits, and signals take some for each.
const MOST: u64 = 1 << 28;
/// The longest duration of a phase, s.
const DAY: f64 = 86_400.0;
/// Width of a lane that has none, m: `SUMO_const_laneWidth`.
const LANE_WIDTH: f64 = 3.2;

/// What an edge is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Function {
    #[default]
    Normal,
    Internal,
    Crossing,
    WalkingArea,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Edge {
    pub(super) id: String,
    pub(super) from: String,
    pub(super) to: String,
    pub(super) function: Function,
    pub(super) priority: f64,
    pub(super) kind: String,
    pub(super) name: Option<String>,
    pub(super) shape: Line,
    /// From the outside inwards.
    pub(super) lanes: Vec<Lane>,
    /// The edges that a crossing crosses.
    pub(super) crossed: Vec<String>,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Lane {
    pub(super) id: String,
    pub(super) shape: Line,
    pub(super) width: f64,
    pub(super) speed: f64,
    pub(super) length: f64,
    pub(super) usage: Usage,
}

/// Who goes on a lane first of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Usage {
    #[default]
    Cars,
    Buses,
    Bicycles,
    People,
    /// Rails, waterways, or nobody.
    Others,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Junction {
    pub(super) id: String,
    pub(super) kind: String,
    pub(super) center: Point2,
    pub(super) height: f64,
    pub(super) outline: Line,
    pub(super) internal_lanes: Vec<String>,
    pub(super) requests: Vec<Request>,
}

/// To whom a link gives way and whom it meets: of each link a digit, the last one that of link 0.
#[derive(Clone, Debug, Default)]
pub(super) struct Request {
    pub(super) index: usize,
    pub(super) response: Vec<u8>,
    pub(super) foes: Vec<u8>,
}

impl Request {
    pub(super) fn has(digits: &[u8], link: usize) -> bool {
        digits.len().checked_sub(link + 1).is_some_and(|place| digits[place] == b'1')
    }
}

#[derive(Clone, Debug, Default)]
pub(super) struct Connection {
    pub(super) from: String,
    pub(super) to: String,
    pub(super) lanes: (usize, usize),
    pub(super) via: Option<String>,
    /// The signal and the index of its link.
    pub(super) light: Option<(String, usize)>,
    pub(super) direction: u8,
}

#[derive(Clone, Debug, Default)]
pub(super) struct Logic {
    pub(super) id: String,
    pub(super) program: String,
    pub(super) kind: String,
    pub(super) offset: f64,
    /// The longest gap in which a phase goes on that follows its vehicles, s, if the file says it.
    pub(super) longest_gap: Option<f64>,
    /// After so long without green, s, whoever waits is preferred, if the file says it.
    pub(super) inactive: Option<f64>,
    /// How far one looks for who has lost time, m, how much that is, s, and whether a phase goes on beyond its longest while nobody comes
    /// elsewhere; what the file says of it.
    pub(super) range: Option<f64>,
    pub(super) least_loss: Option<f64>,
    pub(super) goes_beyond: bool,
    pub(super) phases: Vec<LogicPhase>,
}

impl Logic {
    /// Whether its phases follow their vehicles.
    pub(super) fn is_actuated(&self) -> bool {
        matches!(self.kind.as_str(), "actuated" | "delay_based")
    }

    /// Takes up a parameter.
    fn set(&mut self, element: &Element<'_>) -> Result<(), SumoError> {
        let own = match element.get("key").as_deref() {
            Some("max-gap") => &mut self.longest_gap,
            Some("inactive-threshold") => &mut self.inactive,
            Some("detectorRange" | "detector-range") => &mut self.range,
            Some("minTimeLoss" | "minTimeloss") => &mut self.least_loss,
            Some("extendMaxDur") => {
                self.goes_beyond =
                    matches!(element.get("value").as_deref(), Some("true" | "1" | "yes" | "on"));
                return Ok(());
            }
            _ => return Ok(()),
        };
        *own = Some(element.required_number("value")?);
        Ok(())
    }
}

/// One phase of a program.
#[derive(Clone, Debug)]
pub(super) struct LogicPhase {
    /// By the clock, s.
    pub(super) duration: f64,
    /// Its shortest and longest duration where it follows its vehicles, s.
    pub(super) bounds: (f64, f64),
    /// What each link shows, a letter each.
    pub(super) state: Vec<u8>,
    /// The numbers of the phases that may follow; none if the next in the file does.
    pub(super) next: Vec<usize>,
    /// Whether the file has other conditions of its end than gaps and bounds.
    pub(super) has_conditions: bool,
}

/// All of a file.
#[derive(Clone, Debug, Default)]
pub(super) struct Raw {
    pub(super) lefthand: bool,
    pub(super) offset: (f64, f64),
    pub(super) projection: String,
    pub(super) edges: Vec<Edge>,
    pub(super) junctions: Vec<Junction>,
    pub(super) connections: Vec<Connection>,
    pub(super) logics: Vec<Logic>,
    /// Whether the last of them is being read.
    is_in_logic: bool,
    /// The edges of roundabouts.
    pub(super) rings: Vec<String>,
}

impl Raw {
    pub(super) fn read(reader: impl BufRead) -> Result<Self, SumoError> {
        let mut raw = Self::default();
        xml::read(reader, &["net"], &mut raw)?;
        Ok(raw)
    }
}

impl Visit for Raw {
    fn begin(&mut self, element: &Element<'_>, depth: usize) -> Result<(), SumoError> {
        match (element.name(), depth) {
            ("net", 0) => self.lefthand = element.get("lefthand").as_deref() == Some("true"),
            ("location", 1) => {
                let offset = element.shape("netOffset")?;
                self.offset = offset.points.first().map_or((0.0, 0.0), |point| (point.x, point.y));
                self.projection = element.get("projParameter").unwrap_or_default().into_owned();
            }
            ("edge", 1) => push("edges", &mut self.edges, edge(element)?)?,
            ("lane", 2) => {
                if let Some(edge) = self.edges.last_mut() {
                    push("lanes", &mut edge.lanes, lane(element)?)?;
                }
            }
            ("junction", 1) => push("junctions", &mut self.junctions, junction(element)?)?,
            ("request", 2) => {
                if let Some(junction) = self.junctions.last_mut() {
                    junction.requests.push(request(element)?);
                }
            }
            ("connection", 1) => push("connections", &mut self.connections, connection(element)?)?,
            ("tlLogic", 1) => {
                self.is_in_logic = true;
                push("signals", &mut self.logics, logic(element)?)?;
            }
            ("phase", 2) => {
                if let Some(logic) = self.logics.last_mut() {
                    push("phases", &mut logic.phases, phase(element)?)?;
                }
            }
            ("param", 2) => {
                if let (true, Some(logic)) = (self.is_in_logic, self.logics.last_mut()) {
                    logic.set(element)?;
                }
            }
            ("roundabout", 1) => self.rings.extend(element.words("edges")),
            _ => {}
        }
        Ok(())
    }

    fn end(&mut self, name: &str, _: usize) -> Result<(), SumoError> {
        self.is_in_logic &= name != "tlLogic";
        Ok(())
    }
}

fn push<T>(what: &'static str, list: &mut Vec<T>, thing: T) -> Result<(), SumoError> {
    if list.len() as u64 >= MOST {
        return Err(SumoError::TooMuch { what, limit: MOST });
    }
    list.push(thing);
    Ok(())
}

fn edge(element: &Element<'_>) -> Result<Edge, SumoError> {
    let function = match element.get("function").as_deref() {
        Some("internal") => Function::Internal,
        Some("crossing") => Function::Crossing,
        Some("walkingarea") => Function::WalkingArea,
        _ => Function::Normal,
    };
    let end = |name| if function == Function::Normal { element.text(name) } else { Ok(String::new()) };
    Ok(Edge {
        id: element.text("id")?,
        from: end("from")?,
        to: end("to")?,
        function,
        priority: element.number("priority")?.unwrap_or(-1.0),
        kind: element.get("type").unwrap_or_default().into_owned(),
        name: element.get("name").map(std::borrow::Cow::into_owned).filter(|name| !name.is_empty()),
        shape: element.shape("shape")?,
        lanes: Vec::new(),
        crossed: element.words("crossingEdges"),
    })
}

fn lane(element: &Element<'_>) -> Result<Lane, SumoError> {
    let shape = element.shape("shape")?;
    if shape.points.len() < 2 {
        return Err(element.error("shape", "has fewer than two points"));
    }
    Ok(Lane {
        id: element.text("id")?,
        shape,
        width: element.number("width")?.unwrap_or(LANE_WIDTH),
        speed: element.required_number("speed")?,
        length: element.required_number("length")?,
        usage: usage(element),
    })
}

fn usage(element: &Element<'_>) -> Usage {
    let (allowed, forbidden) = (element.get("allow"), element.get("disallow"));
    let names = |list: &str, class: &str| list.split_whitespace().any(|word| word == class || word == "all");
    let may = |class: &str| match (&allowed, &forbidden) {
        (Some(allowed), _) => names(allowed, class),
        (None, Some(forbidden)) => !names(forbidden, class),
        (None, None) => true,
    };
    let any = |classes: &[&str]| classes.iter().any(|class| may(class));
    match () {
        () if may("passenger") => Usage::Cars,
        () if any(&["bus", "coach", "taxi", "emergency"]) => Usage::Buses,
        () if may("bicycle") => Usage::Bicycles,
        () if may("pedestrian") => Usage::People,
        () => Usage::Others,
    }
}

fn junction(element: &Element<'_>) -> Result<Junction, SumoError> {
    let coordinate = |name| {
        let x = element.required_number(name)?;
        if x.abs() <= 1e7 { Ok(x) } else { Err(element.error(name, "is farther than 10 000 km")) }
    };
    Ok(Junction {
        id: element.text("id")?,
        kind: element.get("type").unwrap_or_default().into_owned(),
        center: Point2::new(coordinate("x")?, coordinate("y")?),
        height: element.number("z")?.unwrap_or(0.0),
        outline: element.shape("shape")?,
        internal_lanes: element.words("intLanes"),
        requests: Vec::new(),
    })
}

fn request(element: &Element<'_>) -> Result<Request, SumoError> {
    Ok(Request {
        index: element.index("index")?.ok_or_else(|| element.error("index", "is missing"))?,
        response: element.text("response")?.into_bytes(),
        foes: element.text("foes")?.into_bytes(),
    })
}

fn connection(element: &Element<'_>) -> Result<Connection, SumoError> {
    let light = element.get("tl").map(std::borrow::Cow::into_owned).filter(|light| !light.is_empty());
    let link = element.index("linkIndex")?;
    Ok(Connection {
        from: element.text("from")?,
        to: element.text("to")?,
        lanes: (element.index("fromLane")?.unwrap_or(0), element.index("toLane")?.unwrap_or(0)),
        via: element.get("via").map(std::borrow::Cow::into_owned),
        light: light.zip(link),
        direction: element.get("dir").and_then(|dir| dir.bytes().next()).unwrap_or(b's'),
    })
}

fn logic(element: &Element<'_>) -> Result<Logic, SumoError> {
    Ok(Logic {
        id: element.text("id")?,
        program: element.get("programID").unwrap_or_default().into_owned(),
        kind: element.get("type").unwrap_or_default().into_owned(),
        offset: element.number("offset")?.unwrap_or(0.0),
        longest_gap: None,
        inactive: None,
        range: None,
        least_loss: None,
        goes_beyond: false,
        phases: Vec::new(),
    })
}

fn phase(element: &Element<'_>) -> Result<LogicPhase, SumoError> {
    let time = |name: &'static str, value: f64| {
        let is_one = (0.0..=DAY).contains(&value);
        if is_one { Ok(value) } else { Err(element.error(name, "is out of range: give 0 to 86 400 s")) }
    };
    let duration = time("duration", element.required_number("duration")?)?;
    let least = element.number("minDur")?;
    // Who says how long it lasts at least, and no more, lets it go on while vehicles come.
    let longest = element.number("maxDur")?.unwrap_or(if least.is_some() { DAY } else { duration });
    let bounds = (time("minDur", least.unwrap_or(duration))?, time("maxDur", longest)?);
    if bounds.0 > bounds.1 {
        return Err(element.error("minDur", "is more than maxDur"));
    }
    let number = |word: &String| word.parse::<u32>().ok().map(|number| number as usize);
    let next: Option<Vec<usize>> = element.words("next").iter().map(number).collect();
    let next = next.ok_or_else(|| element.error("next", "has a word that is no number of a phase"))?;
    let conditions = ["earlyTarget", "finalTarget", "earliestEnd", "latestEnd"];
    let has_conditions = conditions.iter().any(|name| element.get(name).is_some());
    Ok(LogicPhase { duration, bounds, state: element.text("state")?.into_bytes(), next, has_conditions })
}
