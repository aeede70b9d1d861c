//! The grammar planner: sentences and function calls to plans, by rules and without a model.
//!
//! A sentence is read from left to right into orders, and each order is worked out in the scene from where the
//! earlier ones leave the agent. What is not understood is never dropped: it gives a
//! [`PlanError`] that quotes the words, says what would be understood and what is near. The planner keeps nothing
//! between sentences, so "it" and "there" refer to words of the same sentence.
//!
//! Distances are in m, seen from the agent; of two things at the same distance the lower id is meant.

mod adjectives;
mod again;
mod alternatives;
mod asides;
mod between;
mod blocks;
mod call;
mod chatter;
mod choices;
mod clause;
mod clipped;
mod compass;
mod conditions;
mod contraries;
mod corrections;
mod deeds;
mod deferred;
mod described;
mod dialects;
mod draft;
mod driving;
pub(crate) mod edits;
mod enumerated;
mod fetched;
mod following;
mod fractions;
mod fronted;
mod gazes;
mod gestures;
mod handling;
mod hearing;
mod idle;
mod in_turn;
mod itineraries;
pub(crate) mod lexer;
mod lexicon;
mod modifiers;
mod motion;
mod names;
mod nominal;
pub(crate) mod numbers;
mod orders;
mod paces;
pub(crate) mod paint;
mod parser;
mod passengers;
mod passive;
mod pauses;
mod phrases;
mod pointing;
mod politeness;
mod portions;
mod reference;
mod relate;
mod remarks;
mod repairs;
mod repeats;
mod reported;
mod requests;
mod resolve;
mod restarts;
mod retold;
mod routes;
mod rows;
pub(crate) mod scenes;
mod sequence;
mod shares;
mod shopping;
mod shuttles;
#[cfg(feature = "thought")]
mod skies;
mod slips;
mod sorts;
mod speech;
mod spelling;
mod stands;
mod statements;
mod staying;
pub(crate) mod streets;
#[cfg(feature = "thought")]
mod structured;
mod tails;
mod talk;
mod tests_of;
mod tests_of_others;
mod tests_of_self;
mod thereabouts;
mod things;
mod topics;
mod turnings;
mod unknown;
mod verbs;
mod via;
mod wants;
mod ways;
mod weather;
mod whereabouts;

#[cfg(feature = "thought")]
pub(crate) use compass::winds;
use draft::Draft;
use names::Names;
#[cfg(feature = "thought")]
pub(crate) use paint::{name_of_color, named_colors};
use parser::{Parser, shortened};
use resolve::View;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::seam::{Plan, PlanError, Planner};
#[cfg(feature = "thought")]
pub(crate) use skies::{names_of_sky, sky_by_names, sky_names};
#[cfg(feature = "thought")]
pub(crate) use structured::{Order, plan_orders};

/// The longest sentence that is read, in characters.
const LONGEST_SENTENCE: usize = 2000;

/// How far away things may be that a sentence is about, m.
const RANGE: f64 = 5000.0;

/// Understands a small language, the same way every time.
///
/// ```
/// use simworld_agents::language::GrammarPlanner;
/// use simworld_core::action::Action;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::intent::Intent;
/// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
/// use simworld_core::seam::{Goal, PlanStep, Planner};
///
/// let mut world = World::new();
/// let at = |x| pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
/// let person = Shape::Capsule { radius: 0.25, height: 1.8 };
/// let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0), person))?;
/// let chair = world.spawn(EntityDesc::new(EntityKind::Chair, at(9.0), Shape::cuboid(0.5, 0.5, 0.9)))?;
///
/// let words = Intent::Words("go to the nearest chair and sit down".into());
/// let plan = GrammarPlanner::default().plan(&words, &world, me)?;
/// let [PlanStep::Navigate { to, .. }, PlanStep::Act(action)] = &plan.steps[..] else { panic!("two steps") };
/// assert_eq!(*to, Goal::Entity(chair));
/// assert_eq!(*action, Action::SitDown { seat: chair });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct GrammarPlanner {
    policy: AmbiguityPolicy,
    speaker: Option<EntityId>,
}

/// What to do when several things fit a description: "the bench" where there are two.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AmbiguityPolicy {
    /// Takes the one with the lowest id, wherever the agent stands.
    First,
    /// Takes the nearest.
    #[default]
    Nearest,
    /// Asks back: [`PlanError::Ambiguous`] lists what could be meant.
    Ask,
}

impl GrammarPlanner {
    /// A planner that treats what is ambiguous so.
    pub const fn with_policy(policy: AmbiguityPolicy) -> Self {
        Self { policy, speaker: None }
    }

    /// The planner for what this entity says: it is who "me" stands for, and where "come here" leads. Without a speaker
    /// "me" is nobody, and "here" is where the agent stands.
    #[must_use]
    pub const fn spoken_by(mut self, speaker: EntityId) -> Self {
        self.speaker = Some(speaker);
        self
    }

    /// The calls that are understood, each with its arguments; a question mark follows those that may be left out.
    pub const fn calls() -> &'static [(&'static str, &'static [&'static str])] {
        call::CALLS
    }
}

impl Planner for GrammarPlanner {
    fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
        let me = scene.entity(who).ok_or(PlanError::Missing { id: who })?;
        let view = View { speaker: self.speaker, ..View::new(scene, &me, self.policy) };
        let names = Names::new(scene, me.planar(), RANGE);
        let clauses = match intent {
            Intent::Words(words) if words.chars().count() > LONGEST_SENTENCE => {
                let hint = format!("say it in at most {LONGEST_SENTENCE} characters");
                return Err(PlanError::NotUnderstood {
                    words: shortened(words),
                    fragment: String::new(),
                    hint,
                });
            }
            Intent::Words(words) => return Self::meant(words, &names, &view, &me),
            Intent::Call { name, args } => vec![call::read(name, args, &names, &view)?],
            Intent::Plan(_) | Intent::Act(_) => return Ok(intent.ready().unwrap_or_default()),
        };
        drafted(&clauses, view, &me)
    }
}

/// The plan that orders make.
fn drafted(clauses: &[clause::Clause], view: View<'_>, me: &EntityRef<'_>) -> Result<Plan, PlanError> {
    let mut draft = Draft::new(view, me);
    draft.add_all(clauses)?;
    Ok(draft.finish())
}

impl GrammarPlanner {
    /// The plan that words mean. Where something is not here of which only the talk before an order tells ("the forecast looked awful"), the
    /// order is what is meant.
    fn meant(words: &str, names: &Names<'_>, view: &View<'_>, me: &EntityRef<'_>) -> Result<Plan, PlanError> {
        let drafted = |clauses: &[clause::Clause]| drafted(clauses, view.clone(), me);
        drafted(&Self::said(words, names, view, me)?).or_else(|refused| {
            if !matches!(refused, PlanError::NotFound { .. }) {
                return Err(refused);
            }
            let orders = told_otherwise(&listened(words, me), names).into_iter();
            let mut plans = orders.map(|told| drafted(&read(words, told, names, view)?));
            plans.find_map(Result::ok).ok_or(refused)
        })
    }

    /// What is made of words: as they stand, as they are corrected in the same breath, or with the pauses of who looks for words.
    fn said(
        words: &str,
        names: &Names<'_>,
        view: &View<'_>,
        me: &EntityRef<'_>,
    ) -> Result<Vec<clause::Clause>, PlanError> {
        let heard = |words: &str| {
            let mut lexemes = listened(words, me);
            if idle::tells_how_it_was(&lexemes) {
                let hint = "that is how it was: say what is to be done".to_owned();
                return Err(PlanError::NotUnderstood {
                    words: shortened(words),
                    fragment: shortened(words),
                    hint,
                });
            }
            let said = repairs::mend(&mut lexemes);
            read(words, lexemes.clone(), names, view)
                .or_else(|refused| match said {
                    Some(said) if !understood(&refused) => read(words, said, names, view).or(Err(refused)),
                    _ => Err(refused),
                })
                .or_else(|refused| in_other_words(refused, words, &lexemes, names, view))
        };
        let clauses = heard(words).or_else(|refused| match hearing::pausing(words) {
            Some(paused) if !understood(&refused) => heard(&paused).or(Err(refused)),
            _ => Err(refused),
        });
        let mut clauses = clauses.map_err(|refused| match unknown::unknown_deed(words, names) {
            Some(noun) if !understood(&refused) => {
                PlanError::NotFound { wanted: noun, near: view.surroundings() }
            }
            _ => refused,
        })?;
        enumerated::once_each(&mut clauses, words);
        enumerated::without_announced_photo(&mut clauses, words);
        Ok(clauses)
    }
}

/// What is heard, put straight where that changes nothing.
fn listened(words: &str, me: &EntityRef<'_>) -> Vec<lexer::Lexeme> {
    let mut lexemes = hearing::hear(words, me.info.name.as_deref());
    fractions::in_one(&mut lexemes);
    chatter::plainly(&mut lexemes, words);
    talk::leave_out_before_but(&mut lexemes);
    in_turn::told_one_by_one(&mut lexemes);
    lexemes
}

/// What was refused, without talk and in plainer words: a plan if there is one, or else an answer that says more.
fn in_other_words(
    refused: PlanError,
    words: &str,
    heard: &[lexer::Lexeme],
    names: &Names<'_>,
    view: &View<'_>,
) -> Result<Vec<clause::Clause>, PlanError> {
    if matches!(refused, PlanError::Ambiguous { .. }) {
        return Err(refused);
    }
    let mut answer = refused;
    for lexemes in told_otherwise(heard, names) {
        match read(words, lexemes, names, view) {
            Err(other) if understood(&other) && !understood(&answer) => answer = other,
            Err(_) => {}
            read => return read,
        }
    }
    Err(answer)
}

/// What was heard without talk and in plainer words, in the order in which it is to be tried.
fn told_otherwise(heard: &[lexer::Lexeme], names: &Names<'_>) -> Vec<Vec<lexer::Lexeme>> {
    let mut corrected = heard.to_vec();
    spelling::correct(&mut corrected, names);
    let bare = talk::without_idioms(&corrected);
    let whole = bare.as_deref().unwrap_or(&corrected);
    let named = talk::without_epithets(whole, names);
    let whole = named.as_deref().unwrap_or(whole);
    let mut all: Vec<_> = talk::with_the_name(whole, names).into_iter().collect();
    let told = std::iter::once(whole).chain(talk::without_talk(whole, names));
    for told in told.flat_map(|told| std::iter::once(told).chain(talk::without_tail(told, names))) {
        let plain = retold::retold(told, names);
        let mut anew = told.to_vec();
        repairs::mend(&mut anew); // what is told in the talk may have hidden a slip
        all.extend((anew != corrected).then_some(anew));
        all.extend(plain);
    }
    all
}

/// Whether an answer says more than that nothing was understood.
const fn understood(refused: &PlanError) -> bool {
    !matches!(refused, PlanError::NotUnderstood { .. })
}

/// Reads what was heard; what is not understood as it is may be without its remarks, or told straight.
fn read(
    words: &str,
    mut lexemes: Vec<lexer::Lexeme>,
    names: &Names<'_>,
    view: &View<'_>,
) -> Result<Vec<clause::Clause>, PlanError> {
    spelling::correct(&mut lexemes, names);
    passive::put_verbs_first(&mut lexemes);
    let parse = |lexemes: &[lexer::Lexeme]| Parser::new(words, lexemes, names, view).sentence();
    let says_more = |read: &Result<_, PlanError>| read.as_ref().err().is_none_or(understood);
    parse(&lexemes).or_else(|refused| {
        if let Some(rest) = idle::without_remarks(&lexemes, words, names).map(parse).find(says_more) {
            return rest;
        }
        let Some(told) = restarts::told_straight(&lexemes) else { return Err(refused) };
        let mut rest =
            std::iter::once(parse(&told)).chain(idle::without_remarks(&told, words, names).map(parse));
        rest.find(says_more).unwrap_or(Err(refused))
    })
}
