//! Minds in threads of their own: the world waits for none, nothing they want is lost or used twice, and a run replays.

#![expect(
    clippy::disallowed_methods,
    reason = "minds live in the time of life; so does the patience of these tests"
)]

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::thread::sleep;
use std::time::{Duration, Instant};

use crate::episode_common::{ConeHunt, agent, field, words};
use simworld_agents::asynchronous::{
    AsynchronousConfig, AsynchronousEpisode, AsynchronousError, Fate, FreeMind, MindState, Pace, Receipt,
};
use simworld_agents::episode::Episode;
use simworld_agents::mind::{Mind, MindError, Silent};
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::event::Event;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seed::{Seed, StreamRng};

pub(crate) const FIRST: EntityId = EntityId::new(1, 0);
const SECOND: EntityId = EntityId::new(2, 0);

fn fresh(seed: Seed) -> Episode<ConeHunt> {
    let (simulation, ids) = field();
    let agents = ids.into_iter().map(|id| agent(id, Silent)).collect();
    let mut episode = Episode::new(simulation, ConeHunt::default(), agents, seed).unwrap();
    episode.set_trail_interval(1);
    episode
}

pub(crate) fn fast() -> AsynchronousConfig {
    AsynchronousConfig { pace: Pace::AsFastAsPossible, ..AsynchronousConfig::default() }
}

pub(crate) fn begin(
    seed: u64,
    config: AsynchronousConfig,
    minds: Vec<(EntityId, FreeMind<ConeHunt>)>,
) -> AsynchronousEpisode<ConeHunt, ConeHunt> {
    AsynchronousEpisode::new(fresh(Seed(seed)), minds, config, ConeHunt::clone).unwrap()
}

/// Does what a closure says.
struct Does<F>(F);

impl<T, F> Mind<T> for Does<F>
where
    F: FnMut(&dyn Scene, &mut Vec<Intent>) -> Result<(), String>,
{
    fn decide(
        &mut self,
        _: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        (self.0)(scene, out).map_err(|reason| MindError { who, reason })
    }
}

fn does<F>(act: F) -> FreeMind<ConeHunt>
where
    F: FnMut(&dyn Scene, &mut Vec<Intent>) -> Result<(), String> + Send + 'static,
{
    Box::new(Does(act))
}

/// Waits in each thought until it is let go; tells when the thought begins, and again when it goes on.
fn blocked() -> (FreeMind<ConeHunt>, Sender<()>, Receiver<()>) {
    let (go, may_go) = channel::<()>();
    let (gone, is_gone) = channel();
    let mind = does(move |_, out| {
        let _ = gone.send(());
        let _ = may_go.recv();
        let _ = gone.send(());
        out.push(words("stop"));
        Ok(())
    });
    (mind, go, is_gone)
}

/// Goes on until a blocked mind thinks: its thread begins when the machine has time for it.
fn until_it_thinks(run: &mut AsynchronousEpisode<ConeHunt, ConeHunt>, is_gone: &Receiver<()>) {
    while is_gone.try_recv().is_err() {
        run.step().unwrap();
        sleep(Duration::from_millis(1));
    }
}

/// Replays a recording in lockstep, without minds, and compares every digest.
pub(crate) fn replay(seed: u64, live: &Episode<ConeHunt>) {
    let recording = live.recording();
    let mut again = fresh(Seed(seed));
    for _ in 0..live.simulation().world().clock().tick().0 {
        again.replay_step(&recording).unwrap();
    }
    assert_eq!(again.trail(), recording.trail, "seed {seed}");
}

/// What was wanted, by whom and with which number.
type Wanted = Arc<Mutex<Vec<(EntityId, i64)>>>;

/// A panic that nobody has to read: it unwinds as any other.
fn panic_quietly(words: &'static str) -> ! {
    std::panic::resume_unwind(Box::new(words))
}

/// Thinks for random times, sometimes wants several things, and perhaps dies.
fn erratic(who: EntityId, mut rng: StreamRng, wanted: Wanted) -> FreeMind<ConeHunt> {
    let mut serial = 0;
    let dies_after = if rng.chance(0.3) { rng.below(6) } else { usize::MAX };
    let panics = rng.chance(0.5);
    let mut thoughts = 0;
    does(move |_, out| {
        sleep(Duration::from_micros(rng.below(1500) as u64));
        thoughts += 1;
        if thoughts > dies_after {
            if panics {
                panic_quietly("an erratic mind panics");
            }
            return Err("an erratic mind fails".to_owned());
        }
        for _ in 0..rng.below(3) {
            wanted.lock().unwrap().push((who, serial));
            out.push(match rng.below(3) {
                0 => Intent::call("cheer").arg("serial", serial),
                1 => words(&format!("go to ({}, {serial})", rng.below(20))),
                _ => Intent::call("nonsense").arg("serial", serial),
            });
            serial += 1;
        }
        Ok(())
    })
}

/// One random schedule: of minds, delays, deaths, gatherings, ages and of the world's own steps.
fn schedule(seed: u64) {
    let stream = Seed(seed).stream("schedules");
    let mut rng = stream.rng();
    let wanted = Wanted::default();
    let mind = |who: EntityId| (who, erratic(who, stream.indexed(u64::from(who)).rng(), Arc::clone(&wanted)));
    let config = AsynchronousConfig {
        gather: [0.1, 0.3, 1.0][rng.below(3)],
        max_age: [None, Some(0.0), Some(2.0)][rng.below(3)],
        ..fast()
    };
    let mut run = begin(seed, config, vec![mind(FIRST), mind(SECOND)]);
    let mut receipts = Vec::new();
    for _ in 0..60 {
        if run.episode().is_over() {
            break;
        }
        sleep(Duration::from_micros(rng.below(200) as u64));
        run.step().unwrap();
        receipts.extend(run.take_receipts());
    }
    let accounts = run.accounts();
    let (episode, ending) = run.finish();
    receipts.extend(ending.receipts);
    assert_eq!(ending.still_thinking, []);
    check_receipts(&episode, &receipts, &wanted.lock().unwrap(), config.gather);
    assert_eq!(accounts.handed_in(), accounts.applied() + accounts.late() + accounts.refused());
    replay(seed, &episode);
}

/// Everything wanted has one receipt, and what was applied stands once in the recording, at its tick.
fn check_receipts(
    episode: &Episode<ConeHunt>,
    receipts: &[Receipt],
    wanted: &[(EntityId, i64)],
    gather: f64,
) {
    let mut by_mind: BTreeMap<EntityId, Vec<&Receipt>> = BTreeMap::new();
    for receipt in receipts {
        by_mind.entry(receipt.who).or_default().push(receipt);
    }
    assert_eq!(receipts.len(), wanted.len(), "one receipt for each");
    for (who, receipts) in &by_mind {
        let serials: Vec<u64> = receipts.iter().map(|receipt| receipt.serial).collect();
        assert_eq!(serials, (0..receipts.len() as u64).collect::<Vec<_>>(), "{who}, in order");
        assert_eq!(wanted.iter().filter(|(other, _)| other == who).count(), receipts.len());
    }
    let applied = receipts.iter().filter_map(|receipt| match receipt.fate {
        Fate::Applied { tick } => Some((tick, receipt.who, receipt.serial)),
        _ => None,
    });
    let mut applied: Vec<(Tick, EntityId, u64)> = applied.collect();
    applied.sort_unstable();
    let recording = episode.recording();
    let mut used: Vec<(Tick, EntityId)> = Vec::new();
    for stamped in &recording.commands {
        let Command::Intend { who, .. } = stamped.command else { panic!("nobody else commands") };
        used.push((stamped.tick, who));
    }
    used.sort_unstable();
    assert_eq!(applied.iter().map(|(tick, who, _)| (*tick, *who)).collect::<Vec<_>>(), used);
    let steps = (gather / 0.1).round() as u64;
    assert!(applied.iter().all(|(tick, ..)| tick.0.is_multiple_of(steps)), "gathered at the interval");
}

#[test]
fn random_schedules_lose_nothing_and_replay() {
    let schedules = if std::env::var_os("SIMWORLD_SOAK").is_some() { 1000 } else { 40 };
    let faults: Vec<u64> =
        (0..schedules).filter(|seed| std::panic::catch_unwind(|| schedule(*seed)).is_err()).collect();
    assert_eq!(faults, [0; 0], "these seeds went wrong; run one alone to see why");
}

#[test]
fn the_world_does_not_wait_for_a_mind() {
    let (slow, go, is_gone) = blocked();
    let mut run = begin(1, fast(), vec![(FIRST, slow), (SECOND, Box::new(Silent))]);
    until_it_thinks(&mut run, &is_gone);
    let begun = run.minds().next();
    for _ in 0..100 {
        run.step().unwrap(); // would stand still for good here
    }
    assert_eq!(run.minds().next(), begun);
    go.send(()).unwrap();
    is_gone.recv().unwrap();
    let receipt = loop {
        run.step().unwrap();
        if let Some(receipt) = run.take_receipts().pop() {
            break receipt;
        }
        sleep(Duration::from_millis(1));
    };
    let Fate::Applied { tick } = receipt.fate else { panic!("it is taken: {receipt:?}") };
    assert_eq!(begun, Some((FIRST, MindState::Thinking { seen: receipt.seen })));
    assert!(tick.0 >= receipt.seen.0 + 100, "it answers to what it saw long ago");
    drop(go);
    let (episode, _) = run.finish();
    replay(1, &episode);
}

/// A mind behind a real connection: its server answers when it is let go, and the world steps on meanwhile.
#[cfg(feature = "http")]
#[test]
fn the_world_does_not_wait_for_a_server() {
    use crate::fault_server::{FaultServer, says};
    use simworld_agents::model::{ChatModel, ChatRequest, Message, OpenAiChat, OpenAiConfig};

    let (go, may_go) = channel::<()>();
    let may_go = Mutex::new(may_go);
    let server = FaultServer::by_rule(move |_| {
        let _ = may_go.lock().unwrap().recv();
        says("stop")
    });
    let mut model = OpenAiChat::new(OpenAiConfig { timeout: 60.0, ..server.config() }).unwrap();
    let mind = does(move |_, out| {
        let reply = model.chat(&ChatRequest::new([Message::user("What now?")]));
        out.push(words(&reply.map_err(|error| error.to_string())?.text));
        Ok(())
    });
    let mut run = begin(1, fast(), vec![(FIRST, mind)]);
    while server.heard().is_empty() {
        run.step().unwrap();
        sleep(Duration::from_millis(1));
    }
    let asked = run.episode().simulation().world().clock().tick();
    for _ in 0..100 {
        run.step().unwrap();
    }
    assert!(run.take_receipts().is_empty(), "nothing was answered yet");
    go.send(()).unwrap();
    let receipt = loop {
        run.step().unwrap();
        if let Some(receipt) = run.take_receipts().pop() {
            break receipt;
        }
        sleep(Duration::from_millis(1));
    };
    let Fate::Applied { tick } = receipt.fate else { panic!("it is taken: {receipt:?}") };
    assert!(tick.0 >= asked.0 + 100 && receipt.seen <= asked, "{receipt:?}, asked at {asked}");
    drop(go);
    let (episode, _) = run.finish();
    replay(1, &episode);
}

/// Keeps the ticks of what it is told of, and thinks as long as it is made to.
struct Witness {
    told: Arc<Mutex<Vec<Event>>>,
    may_go_on: Receiver<()>,
}

impl<T> Mind<T> for Witness {
    fn notice(&mut self, events: &[Event], _: EntityId) {
        self.told.lock().unwrap().extend_from_slice(events);
    }

    fn decide(&mut self, _: &T, _: &dyn Scene, _: EntityId, _: &mut Vec<Intent>) -> Result<(), MindError> {
        let _ = self.may_go_on.recv();
        Ok(())
    }
}

#[test]
fn what_happened_meanwhile_is_told_once_and_in_order() {
    let (go_on, may_go_on) = channel();
    let told = Arc::new(Mutex::new(Vec::new()));
    let witness: FreeMind<ConeHunt> = Box::new(Witness { told: Arc::clone(&told), may_go_on });
    let mut run = begin(1, fast(), vec![(FIRST, witness)]);
    let mut happened = run.episode().events().to_vec();
    for step in 0..600 {
        if run.episode().is_over() {
            break;
        }
        if step % 7 == 0 {
            run.submit(Command::Intend { who: SECOND, intent: words(&format!("abracadabra {step}")) });
        }
        run.step().unwrap();
        happened.extend_from_slice(run.episode().events());
        if step % 50 == 49 {
            go_on.send(()).unwrap();
            sleep(Duration::from_millis(1));
        }
    }
    drop(go_on);
    drop(run);
    let told = told.lock().unwrap();
    assert!(told.len() > 10, "it was told of what happened: {told:?}");
    assert_eq!(*told, happened[..told.len()]);
}

#[test]
fn what_is_too_old_is_late_and_changes_nothing() {
    let (slow, go, is_gone) = blocked();
    let config = AsynchronousConfig { max_age: Some(5.0), ..fast() };
    let mut run = begin(1, config, vec![(FIRST, slow)]);
    until_it_thinks(&mut run, &is_gone);
    for _ in 0..100 {
        run.step().unwrap();
    }
    go.send(()).unwrap();
    is_gone.recv().unwrap();
    let receipt = loop {
        run.step().unwrap();
        if let Some(receipt) = run.take_receipts().pop() {
            break receipt;
        }
        sleep(Duration::from_millis(1));
    };
    assert!(matches!(receipt.fate, Fate::Late { tick } if tick >= Tick(100)), "{receipt:?}");
    assert!(run.episode().recording().commands.is_empty());
    drop(go);
}

#[test]
fn who_fails_or_panics_is_dead_and_the_rest_go_on() {
    let panicking = does(|_, _| panic_quietly("a thought too many"));
    let mut thoughts = 0;
    let failing = does(move |_, out| {
        thoughts += 1;
        out.push(Intent::call("cheer"));
        if thoughts > 3 { Err("out of ideas".to_owned()) } else { Ok(()) }
    });
    let mut run = begin(1, fast(), vec![(FIRST, panicking), (SECOND, failing)]);
    let is_dead = |state: &MindState, words: &str| matches!(state, MindState::Dead { reason } if reason.contains(words));
    let deadline = Instant::now() + Duration::from_mins(1);
    loop {
        run.step().unwrap();
        let states: Vec<MindState> = run.minds().map(|(_, state)| state).collect();
        if is_dead(&states[0], "a thought too many") && is_dead(&states[1], "out of ideas") {
            break;
        }
        assert!(Instant::now() < deadline, "nobody died: {states:?}");
        sleep(Duration::from_millis(1));
    }
    run.step().unwrap();
    // what it wanted in the thought that failed was never handed in
    assert_eq!((run.accounts().handed_in(), run.accounts().applied()), (3, 3));
    let (episode, ending) = run.finish();
    assert_eq!((ending.receipts.len(), ending.still_thinking.len()), (3, 0));
    replay(1, &episode);
}

#[test]
fn whose_body_is_gone_is_refused_with_the_reason() {
    let mut said = false;
    let mind = does(move |scene, out| {
        if scene.clock().tick().0 >= 3 && !said {
            said = true;
            out.push(words("stop"));
        }
        Ok(())
    });
    let mut episode = fresh(Seed(1));
    episode.submit(Command::Remove { id: FIRST });
    let mut run = AsynchronousEpisode::new(episode, vec![(FIRST, mind)], fast(), ConeHunt::clone).unwrap();
    let receipt = loop {
        run.step().unwrap();
        if let Some(receipt) = run.take_receipts().pop() {
            break receipt;
        }
        sleep(Duration::from_millis(1));
    };
    assert_eq!(receipt.fate, Fate::Refused { reason: "its body is in the world no more" });
}

#[test]
fn threads_end_with_the_run_or_after_their_thought() {
    let token = Arc::new(());
    let holding = |token: &Arc<()>| {
        let token = Arc::clone(token);
        does(move |_, _| {
            assert!(Arc::strong_count(&token) > 1, "the test holds one too");
            Ok(())
        })
    };
    let mut run = begin(1, fast(), vec![(FIRST, holding(&token)), (SECOND, holding(&token))]);
    run.step().unwrap();
    drop(run);
    assert_eq!(Arc::strong_count(&token), 1, "dropping the run ends the threads, and with them the minds");

    let (go, may_go) = channel::<()>();
    let (begun, has_begun) = channel();
    let held = Arc::clone(&token);
    let stubborn = does(move |_, out| {
        let _ = begun.send(());
        assert!(Arc::strong_count(&held) > 1, "the test holds one too");
        let _ = may_go.recv();
        out.push(words("stop"));
        Ok(())
    });
    let config = AsynchronousConfig { patience: Duration::from_millis(20), ..fast() };
    let mut run = begin(1, config, vec![(FIRST, stubborn)]);
    run.step().unwrap();
    has_begun.recv().unwrap();
    let accounts = run.accounts();
    let (_, ending) = run.finish();
    assert_eq!(ending.still_thinking, [FIRST], "the end does not wait for good");
    drop(go);
    let deadline = Instant::now() + Duration::from_mins(1);
    while Arc::strong_count(&token) > 1 {
        assert!(Instant::now() < deadline, "its thread is there for good");
        sleep(Duration::from_millis(1));
    }
    assert_eq!((accounts.handed_in(), accounts.refused()), (1, 1), "what comes after the end is refused");
}

#[test]
fn real_time_is_kept_from_below() {
    let config =
        AsynchronousConfig { pace: Pace::RealTime { factor: 50.0 }, ..AsynchronousConfig::default() };
    let mut run = begin(1, config, vec![(FIRST, Box::new(Silent))]);
    let start = Instant::now();
    for _ in 0..31 {
        run.step().unwrap();
    }
    // the first step begins at once, each other 2 ms after the one before or later
    assert!(start.elapsed() >= Duration::from_millis(60), "{:?}", start.elapsed());
    assert_eq!(run.pace().ticks, 31);
    assert!(run.pace().mean() <= run.pace().worst);
}

#[test]
fn what_cannot_be_is_refused_before_it_begins() {
    let episode = || fresh(Seed(1));
    let silent = || -> FreeMind<ConeHunt> { Box::new(Silent) };
    let twice = AsynchronousEpisode::new(
        episode(),
        vec![(FIRST, silent()), (FIRST, silent())],
        fast(),
        ConeHunt::clone,
    );
    assert!(matches!(twice.err(), Some(AsynchronousError::Mind { who: FIRST, .. })));
    let nobody = EntityId::new(77, 0);
    let stranger = AsynchronousEpisode::new(episode(), vec![(nobody, silent())], fast(), ConeHunt::clone);
    assert!(matches!(stranger.err(), Some(AsynchronousError::Mind { .. })));
    for config in [
        AsynchronousConfig { pace: Pace::RealTime { factor: 0.0 }, ..fast() },
        AsynchronousConfig { pace: Pace::RealTime { factor: f64::NAN }, ..fast() },
        AsynchronousConfig { gather: -1.0, ..fast() },
        AsynchronousConfig { max_age: Some(f64::INFINITY), ..fast() },
        AsynchronousConfig { patience: Duration::from_secs(1_000_000), ..fast() },
    ] {
        let refused = AsynchronousEpisode::new(episode(), Vec::new(), config, ConeHunt::clone).err();
        assert!(matches!(refused, Some(AsynchronousError::Config { .. })), "{config:?}");
    }
}
