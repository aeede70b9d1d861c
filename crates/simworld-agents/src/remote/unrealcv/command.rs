//! The commands that are understood, as a table of templates, and how a line is matched with them.

use std::sync::LazyLock;

use super::answer::Failed;

/// Declares the commands: what each is, its templates, and what it does.
macro_rules! commands {
    ($($verb:ident: $($template:literal),+ => $help:literal;)+) => {
        /// What a command asks.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub(super) enum Verb {
            $($verb,)+
        }

        /// Every command by its templates, with what it does.
        pub(super) const COMMANDS: &[(Verb, &str, &str)] = &[$($((Verb::$verb, $template, $help),)+)+];
    };
}

commands! {
    Status: "vget /unrealcv/status" => "who listens";
    Version: "vget /unrealcv/version" => "the version of this server";
    Commands: "vget /unrealcv/commands" => "every template, one a line";
    Help: "vget /unrealcv/help" => "every template, each with what it does";
    Echo: "vget /unrealcv/echo [str]" => "the same word again";
    Auth: "vset /unrealcv/auth [str]" => "shows the token";
    SceneName: "vget /scene/name", "vget /level/name" => "what the client is connected to";
    SetResolution: "vrun setres [str]" => "gives all cameras a size, such as 1280x720w";
    Run: "vrun [str]", "vrun [str] [str]" => "refused: there is no console of Unreal here";
    Batch: "vbatch [uint]" => "ok: requests sent at once are done at once anyway";

    Objects: "vget /objects" => "the names of all things";
    Spawn: "vset /objects/spawn [str]", "vset /objects/spawn [str] [str]",
        "vset /objects/spawn_bp_asset [str] [str]" => "brings a thing of that class, at the origin; gives its name";
    GetLocation: "vget /object/[str]/location" => "where its origin is, the middle of its bottom, cm";
    SetLocation: "vset /object/[str]/location [float] [float] [float]" => "puts it there, cm";
    GetRotation: "vget /object/[str]/rotation" => "pitch, yaw and roll, degrees";
    SetRotation: "vset /object/[str]/rotation [float] [float] [float]" => "turns it so, degrees";
    GetScale: "vget /object/[str]/scale" => "its scale along its own axes";
    SetScale: "vset /object/[str]/scale [float] [float] [float]" => "scales it; round things alike along x and y";
    GetColor: "vget /object/[str]/color" => "its colour in object masks";
    SetColor: "vset /object/[str]/color [uint] [uint] [uint]" => "gives it a colour in object masks, 0 to 255";
    GetMobility: "vget /object/[str]/mobility" => "Movable or Static";
    SetMobility: "vset /object/[str]/object_mobility [bool]" => "whether location and rotation may be set";
    SetPhysics: "vset /object/[str]/physics [bool]" => "whether it is a body of the physics: its attribute `physics`";
    SetCollision: "vset /object/[str]/collision [bool]" => "whether bodies collide with it";
    Show: "vset /object/[str]/show" => "eyes and cameras see it";
    Hide: "vset /object/[str]/hide" => "nobody sees it, and it throws no shadow; bodies still collide with it";
    SetName: "vset /object/[str]/name [str]" => "gives it another name";
    GetClass: "vget /object/[str]/uclass_name" => "the class that it was brought as, or its kind";
    GetBounds: "vget /object/[str]/bounds" => "the box around it: least and greatest x, y, z, cm";
    Destroy: "vset /object/[str]/destroy" => "takes it away";

    Tick: "vset /action/tick" => "lets the world go on by the tick interval, and answers when it has";
    TickInterval: "vset /action/tick_intervel [float]", "vset /action/tick_interval [float]"
        => "time of a tick, s: whole steps of the world, at least one";
    FrameRate: "vset /action/set_fixed_frame_rate [float]" => "time of a tick, as so many a second";
    Pause: "vset /action/game/pause" => "the world goes on by ticks alone";
    Resume: "vset /action/game/resume" => "the world goes on by itself, in real time";
    CleanGarbage: "vset /action/clean_garbage" => "ok: what is destroyed is gone at once";

    Cameras: "vget /cameras" => "the names of all cameras: camera_ and the number";
    SpawnCamera: "vset /cameras/spawn" => "adds a camera that nobody wears; gives its name";
    GetCameraLocation: "vget /camera/[uint]/location" => "cm";
    SetCameraLocation: "vset /camera/[uint]/location [float] [float] [float]" => "cm; a worn one goes with its wearer from there";
    GetCameraRotation: "vget /camera/[uint]/rotation" => "pitch, yaw and roll, degrees";
    SetCameraRotation: "vset /camera/[uint]/rotation [float] [float] [float]" => "degrees";
    GetCameraPose: "vget /camera/[uint]/pose" => "location and rotation";
    SetCameraPose: "vset /camera/[uint]/pose [float] [float] [float] [float] [float] [float]" => "location and rotation";
    GetFov: "vget /camera/[uint]/fov" => "horizontal field of view, degrees";
    SetFov: "vset /camera/[uint]/fov [float]" => "horizontal field of view, degrees";
    GetSize: "vget /camera/[uint]/size" => "pixels across and down";
    SetSize: "vset /camera/[uint]/size [uint] [uint]" => "pixels across and down";
    Lit: "vget /camera/[uint]/lit [str]" => "a picture: png or bmp";
    Depth: "vget /camera/[uint]/depth [str]" => "planar depth: npy, float32, cm, 65504 for the sky";
    ObjectMask: "vget /camera/[uint]/object_mask [str]" => "every thing in its colour: png or bmp";

    SetState: "vbp [str] SetState [float] [float] [float]" => "a vehicle's throttle, brake and steering; steering 1 is 35° to the right";
    SetVehicleStates: "vbp [str] VSetState [str]" => "the same for several: name,throttle,brake,steering;...";
    MoveForward: "vbp [str] MoveForward" => "walks on at its speed";
    Stop: "vbp [str] StopAgent", "vbp [str] StopPedestrian", "vbp [str] StopAction" => "stands still";
    Turn: "vbp [str] TurnAround [float] [float] [float]", "vbp [str] Rotate_Angle [float] [float] [float]"
        => "duration, angle in degrees to the right, -1 for left or 1 for right; the body takes the time it takes";
    StepForward: "vbp [str] StepForward [float] [float]" => "so many seconds at its speed: 0 forward, 1 back, 2 left, 3 right";
    MoveSpeed: "vbp [str] Move_Speed [float] [float] [float]" => "speed in cm/s, seconds, direction as for stepping forward";
    SetMaxSpeed: "vbp [str] SetMaxSpeed [float]" => "its speed, cm/s; 140 until it is set";
    SetPath: "vbp [str] SetPath [str]", "vbp [str] SetWaypoints [str]" => "keeps a way: x,y;x,y;... in cm";
    FollowPath: "vbp [str] FollowPath", "vbp [str] MovementSimulation" => "goes the way that was set; vehicles drive it";
    TurnRound: "vbp [str] MakeUTurn" => "a vehicle turns round: one that a client brought by its wheel, in a half circle; others by the quickest way to the other direction of their road";
    LookUp: "vbp [str] lookup" => "raises the gaze by 15°";
    LookDown: "vbp [str] lookdown" => "lowers the gaze by 15°";
    SitDown: "vbp [str] SitDown" => "on the nearest free seat in reach; Success";
    StandUp: "vbp [str] StandUp" => "Success";
    GetOnScooter: "vbp [str] GetOnScooter" => "the nearest free scooter in reach";
    GetOffScooter: "vbp [str] GetOffScooter" => "of a rider, or of the scooter that is ridden";
    PickUp: "vbp [str] PickUp [str]" => "in one hand, or in both arms if it is no parcel; Success";
    DropOff: "vbp [str] DropOff" => "puts down what it holds; Success";
    EnterVehicle: "vbp [str] EnterVehicle [str]" => "Success";
    ExitVehicle: "vbp [str] ExitVehicle [str]" => "Success";
    Discuss: "vbp [str] Discussion [uint]" => "turns to the nearest person in earshot";
    Argue: "vbp [str] Arguing [uint]" => "argues with the nearest person in earshot";
    Wave: "vbp [str] Wave2Dog" => "waves at the nearest dog in earshot";
    Direct: "vbp [str] Directing" => "points ahead";
    CollisionCount: "vbp [str] GetCollisionNum" => "how often it came to touch humans, objects, buildings, vehicles since the server began";
    EnableController: "vbp [str] EnableController [bool]" => "ok for true: bodies always obey here";

    Information: "vbp [str] GetInformation" => "where everything is that clients brought; asked of a manager";
    UpdateObjects: "vbp [str] UpdateObjects" => "ok: a manager knows everything at once";
    SetSunDirection: "vbp [str] SetSunDirection [float] [float]" => "pitch and yaw of the light, degrees";
    GetSunDirection: "vbp [str] GetSunDirection" => "pitch and yaw of the light, degrees";
    SetSunIntensity: "vbp [str] SetSunIntensity [float]" => "0 to 100; 1 is 1000 lux";
    GetSunIntensity: "vbp [str] GetSunIntensity" => "0 to 100";
    SetFog: "vbp [str] SetFog [float] [float] [float]" => "density 0 to 100 as visibility: 4 is 1 km; distance and falloff have no counterpart";
    GetFog: "vbp [str] GetFog" => "density; distance and falloff are 0";

    SwitchGreen: "vbp [str] SwitchVehicleFrontGreen" => "vehicles that come to this light go as soon as that is safe, until the junction is started again";
    SwitchWalk: "vbp [str] SetPedestrianWalk" => "people at this light walk as soon as that is safe, until the junction is started again";
    SetDuration: "vbp [str] SetDuration [float] [float] [float]" => "green, yellow and walk of the junction of this light, s: 5 to 600, 2 to 10, 4 to 600";
    AddSignal: "vbp [str] AddVehicleSignal [str]", "vbp [str] AddPedSignal [str]" => "a manager that is an intersection takes note of the light's junction";
    StartSignals: "vbp [str] StartSimulation" => "the junctions that the manager took note of change by themselves";

    PedestrianStates: "vbp [str] PSetState [str]" => "refused: the release says nowhere what it sends here";
    Listen: "vbp [str] Listening [uint]" => "refused: who listens does nothing that others see";
    Sky: "vbp [str] SetAtmosphere [float] [float]", "vbp [str] GetAtmosphere" => "refused: the sky of this world is made of sun, clouds and visibility alone";
}

/// A line that was understood: the words and the numbers in it, in their order.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Order<'a> {
    pub(super) verb: Verb,
    pub(super) words: Vec<&'a str>,
    pub(super) numbers: Vec<f64>,
}

impl Order<'_> {
    /// Some numbers of the line; templates say how many there are.
    pub(super) fn numbers<const N: usize>(&self, from: usize) -> [f64; N] {
        std::array::from_fn(|index| self.numbers.get(from + index).copied().unwrap_or_default())
    }

    /// A word of the line.
    pub(super) fn word(&self, index: usize) -> &str {
        self.words.get(index).copied().unwrap_or_default()
    }

    /// A whole number of the line.
    pub(super) fn whole(&self, index: usize) -> u32 {
        self.numbers.get(index).copied().unwrap_or_default() as u32
    }
}

/// A piece of a template.
enum Piece {
    Exact(&'static str),
    Word,
    Whole,
    Number,
    YesNo,
    /// Pieces between slashes.
    Path(Vec<Piece>),
}

static PATTERNS: LazyLock<Vec<Vec<Piece>>> = LazyLock::new(|| {
    COMMANDS.iter().map(|(_, template, _)| template.split(' ').map(Piece::of).collect()).collect()
});

impl Piece {
    fn of(text: &'static str) -> Self {
        match text {
            "[str]" => Self::Word,
            "[uint]" => Self::Whole,
            "[float]" => Self::Number,
            "[bool]" => Self::YesNo,
            path if path.starts_with('/') => Self::Path(path.split('/').map(Self::of).collect()),
            exact => Self::Exact(exact),
        }
    }

    /// Whether a word fits; what it says is kept.
    fn takes<'a>(&self, word: &'a str, order: &mut Order<'a>) -> Fit {
        let number = match self {
            Self::Exact(exact) => return Fit::of(*exact == word),
            Self::Path(pieces) => {
                let segments: Vec<&str> = word.split('/').collect();
                if pieces.len() != segments.len() {
                    return Fit::No;
                }
                let fits = pieces.iter().zip(segments).map(|(piece, word)| piece.takes(word, order));
                return fits.max().unwrap_or(Fit::No);
            }
            Self::Word => {
                order.words.push(word);
                return if word.is_empty() { Fit::Wrong } else { Fit::Yes };
            }
            Self::Whole => word.parse::<u32>().ok().map(f64::from),
            Self::Number => word.parse::<f64>().ok().filter(|number| number.is_finite()),
            Self::YesNo => match word.to_ascii_lowercase().as_str() {
                "true" | "1" => Some(1.0),
                "false" | "0" => Some(0.0),
                _ => None,
            },
        };
        order.numbers.extend(number);
        if number.is_some() { Fit::Yes } else { Fit::Wrong }
    }
}

/// How well a line fits a template; the worst of its pieces counts.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fit {
    Yes,
    /// It is this command, with other arguments.
    Wrong,
    No,
}

impl Fit {
    const fn of(fits: bool) -> Self {
        if fits { Self::Yes } else { Self::No }
    }
}

/// The command in a line.
pub(super) fn parse(line: &str) -> Result<Order<'_>, Failed> {
    let words: Vec<&str> = line.split_ascii_whitespace().collect();
    let mut wrong = None;
    for (pattern, (verb, template, _)) in PATTERNS.iter().zip(COMMANDS) {
        let mut order = Order { verb: *verb, words: Vec::new(), numbers: Vec::new() };
        match fit(pattern, &words, &mut order) {
            Fit::Yes => return Ok(order),
            Fit::Wrong => wrong = wrong.or(Some(*template)),
            Fit::No => {}
        }
    }
    Err(wrong.map_or_else(|| Failed::NoHandler(line.chars().take(200).collect()), Failed::Arguments))
}

fn fit<'a>(pattern: &[Piece], words: &[&'a str], order: &mut Order<'a>) -> Fit {
    let mut worst = if pattern.len() == words.len() { Fit::Yes } else { Fit::Wrong };
    for (index, piece) in pattern.iter().enumerate() {
        let fit = match (words.get(index), piece) {
            (Some(word), piece) => piece.takes(word, order),
            (None, Piece::Exact(_) | Piece::Path(_)) => Fit::No,
            (None, _) => Fit::Wrong,
        };
        if fit == Fit::No {
            return Fit::No;
        }
        worst = worst.max(fit);
    }
    worst
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn lines_of_the_release_are_understood() {
        for (line, verb, words, numbers) in [
            ("vget /objects", Verb::Objects, vec![], vec![]),
            (
                "vset /object/GEN_BP_1/location 1 -2.5 3e2",
                Verb::SetLocation,
                vec!["GEN_BP_1"],
                vec![1.0, -2.5, 300.0],
            ),
            ("vset /action/tick_intervel 0.05", Verb::TickInterval, vec![], vec![0.05]),
            ("vbp Dog Move_Speed 200 1 0", Verb::MoveSpeed, vec!["Dog"], vec![200.0, 1.0, 0.0]),
            ("vset /object/A/collision True", Verb::SetCollision, vec!["A"], vec![1.0]),
            ("vget /camera/12/lit png", Verb::Lit, vec!["png"], vec![12.0]),
            ("vrun setres 1280x720w", Verb::SetResolution, vec!["1280x720w"], vec![]),
            (
                "vrun Editor.AsyncSkinnedAssetCompilation 2",
                Verb::Run,
                vec!["Editor.AsyncSkinnedAssetCompilation", "2"],
                vec![],
            ),
        ] {
            assert_eq!(parse(line).unwrap(), Order { verb, words, numbers }, "{line}");
        }
    }

    #[test]
    fn wrong_arguments_are_told_from_unknown_commands() {
        for line in [
            "vset /object/A/location 1 2",
            "vset /object/A/location 1 2 x",
            "vbp A SetState 1",
            "vbp A SetFog nan 0 0",
        ] {
            assert!(matches!(parse(line), Err(Failed::Arguments(_))), "{line}");
        }
        for line in ["", "vget", "vget /nothing", "vset /object/A/B/location 1 2 3", "vbp A Fly", "rm -rf /"]
        {
            assert!(matches!(parse(line), Err(Failed::NoHandler(_))), "{line}");
        }
    }

    #[test]
    fn every_template_is_itself_a_line_and_stands_in_the_table_of_the_docs() {
        let table = include_str!("commands.md");
        let listed: Vec<&str> =
            table.split('`').filter(|text| text.starts_with('v') && text.contains(' ')).collect();
        for (verb, template, help) in COMMANDS {
            let line = template
                .replace("[str]", "x")
                .replace("[uint]", "3")
                .replace("[float]", "1.5")
                .replace("[bool]", "true");
            assert_eq!(parse(&line).map(|order| order.verb).unwrap(), *verb, "{line}");
            assert!(listed.contains(template), "commands.md lacks `{template}`");
            assert!(table.contains(help), "commands.md says something else of {template}");
        }
        assert_eq!(listed.len(), COMMANDS.len(), "commands.md lists what there is not");
    }

    proptest! {
        #[test]
        fn any_line_is_a_command_or_an_error(line in "[vgetsp /A-Za-z0-9.\\[\\]-]{0,60}") {
            let _ = parse(&line);
        }
    }
}
