//! Phrases mean the same wherever they stand: every way to ask, every noun phrase and every connective is crossed with
//! the orders, and the plan has to stay what it is. A list of whole sentences would pass no table of this kind.

use crate::sentences_common::city::City;
use crate::sentences_common::notation;
use simworld_agents::language::GrammarPlanner;
use simworld_core::intent::Intent;
use simworld_core::seam::Planner;

/// What is made of the words in the campus, in the notation of the tables.
fn meaning(city: &City, words: &str) -> Result<String, String> {
    let plan = GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &city.world, city.me);
    plan.map(|plan| notation::show(&plan, city)).map_err(|error| error.to_string())
}

/// Asserts that every wording has that plan, and reports all that have another.
fn all_mean(city: &City, wanted: &str, wordings: impl IntoIterator<Item = String>) {
    let others: Vec<String> = wordings
        .into_iter()
        .filter_map(|words| {
            let got = meaning(city, &words);
            (got.as_deref() != Ok(wanted)).then(|| format!("{words:?}: {got:?}"))
        })
        .collect();
    assert!(others.is_empty(), "wanted {wanted}\n{}", others.join("\n"));
}

/// Orders with the plan that each has in the campus.
const ORDERS: [(&str, &str); 8] = [
    ("go to the kiosk", "go kiosk"),
    ("sit on the red bench", "go bench_2, sit bench_2"),
    ("wave at Hana", "wave hana"),
    ("bring the letter to Gus", "go letter, take letter, go gus, give gus"),
    ("buy a newspaper", "go kiosk, buy newspaper"),
    ("open the library door", "go door_lib, open door_lib"),
    ("follow Fay", "follow fay"),
    ("take two photos of the statue", "face statue, repeat 2 { photo }"),
];

#[test]
fn whoever_asks_and_however_the_order_stays() {
    const ASKED: [&str; 18] = [
        "please {}",
        "{}, please",
        "could you {}?",
        "I'd like you to {}",
        "I need you to {}, thanks",
        "would you be so kind as to {}",
        "it would be great if you could {}",
        "your job is to {}",
        "why don't you {}?",
        "{}, will you?",
        "hey there, {}",
        "new task: {}",
        "go ahead and {}",
        "{}, thanks a lot",
        "um, could you maybe {}",
        "I was wondering whether you could {}",
        "{}, that would be great",
        "I'm tired, so {}",
    ];
    let city = City::read("campus");
    for (order, plan) in ORDERS {
        all_mean(&city, plan, ASKED.map(|asked| asked.replace("{}", order)));
    }
}

#[test]
fn what_is_said_beside_an_order_changes_nothing() {
    const BESIDE: [&str; 19] = [
        "my knees won't do it, so {}",
        "Gus has finished his session, so {}",
        "the bus was late today; {}",
        "warm up: {}",
        "who's that over there? {}",
        "don't hurry so, {}",
        "forget the fountain; {}",
        "{}; the canteen can wait",
        "{}, and that's all",
        "{}, no hurry",
        "omg {} lol",
        "u should {} rn",
        "somebody lost a key here. {}",
        "strike that; {}",
        "test run: {}",
        "nobody knows why, but {}",
        "{}, I'll be right back",
        "is that a cat? {}",
        "we had a long day, so {}",
    ];
    let city = City::read("campus");
    for (order, plan) in ORDERS {
        all_mean(&city, plan, BESIDE.map(|beside| beside.replace("{}", order)));
    }
}

#[test]
fn orders_cut_short_are_orders() {
    let city = City::read("campus");
    let left = [
        "left turn",
        "a quarter turn to the left",
        "turn left, say 90 degrees",
        "90 degrees left",
        "take a left",
    ];
    all_mean(&city, "turn 90", left.map(str::to_owned));
    let back = ["to the sign and back", "to the sign and back again"];
    all_mean(&city, "go sign, go (0.0, 0.0)", back.map(str::to_owned));
    let parcel = ["parcel up", "pick up the parcel", "the parcel off the ground", "parcel in your arms"];
    all_mean(&city, "go package, take package", parcel.map(str::to_owned));
    let tour = [
        "the hydrant, the sign, the bin",
        "hydrant first, sign second, bin last",
        "waypoints: hydrant, sign, bin",
    ];
    all_mean(&city, "go hydrant, go sign, go bin", tour.map(str::to_owned));
}

#[test]
fn a_noun_phrase_stands_wherever_a_thing_is_named() {
    /// The red bench, the second nearest and the middle one of three.
    const PHRASES: [&str; 11] = [
        "the red bench",
        "the bench that is red",
        "the bench which is painted red",
        "the second bench",
        "the second nearest bench",
        "the middle bench",
        "the middle one of the three benches",
        "the bench in the middle",
        "the bench that isn't blue",
        "the penultimate bench",
        "the second farthest bench",
    ];
    const VERBS: [(&str, &str); 7] = [
        ("go to {}", "go bench_2"),
        ("walk over to {}", "go bench_2"),
        ("have a seat on {}", "go bench_2, sit bench_2"),
        ("look at {}", "face bench_2"),
        ("point at {}", "point bench_2"),
        ("take a picture of {}", "face bench_2, photo"),
        ("wait by {} for 5 seconds", "go bench_2, wait 5"),
    ];
    let city = City::read("campus");
    for (verb, plan) in VERBS {
        all_mean(&city, plan, PHRASES.iter().map(|phrase| verb.replace("{}", phrase)));
    }
}

#[test]
fn orders_follow_one_another_however_they_are_joined() {
    const JOINED: [&str; 12] = [
        "{a} and {b}",
        "{a}, then {b}",
        "{a} and then {b}",
        "{a}. {b}.",
        "first {a}, then {b}",
        "{a}; after that {b}",
        "before you {b}, {a}",
        "1. {a} 2. {b}",
        "first of all {a}, and finally {b}",
        "{a} - and after that, {b}",
        "step 1: {a}. step 2: {b}",
        "{a}, next {b}",
    ];
    let city = City::read("campus");
    // What one leaves in hand or where one sits changes what comes next: these leave nothing.
    let alone = [ORDERS[0], ORDERS[2], ORDERS[7], ORDERS[5]];
    for (one, first) in alone {
        for (other, second) in alone.into_iter().filter(|(other, _)| *other != one) {
            let joined = JOINED.map(|joined| joined.replace("{a}", one).replace("{b}", other));
            all_mean(&city, &format!("{first}, {second}"), joined);
        }
    }
}

#[test]
fn any_condition_stands_before_and_behind_any_order() {
    const CONDITIONS: [(&str, &str); 11] = [
        ("it is dark", "dark"),
        ("it's already dark", "dark"),
        ("it has got dark", "dark"),
        ("it isn't raining", "not raining"),
        ("the rain has stopped", "not raining"),
        ("the light is green", "light green"),
        ("you see Fay", "see fay"),
        ("you can see Fay", "see fay"),
        ("the library door is open", "open door_lib"),
        ("Gus is near you", "near gus"),
        ("nobody is sitting on the blue bench", "not taken bench_1"),
    ];
    const IF: [&str; 6] = [
        "if {c}, {a}",
        "{a} if {c}",
        "{a}, but only if {c}",
        "in case {c}, {a}",
        "provided that {c}, {a}",
        "please {a} if {c}",
    ];
    const WHEN: [&str; 5] = [
        "when {c}, {a}",
        "as soon as {c}, {a}",
        "once {c}, {a}",
        "wait until {c}, then {a}",
        "the moment {c}, {a}",
    ];
    const UNTIL: [&str; 4] = ["until {c}, {a}", "{a} until {c}", "{a} till {c}", "{a}, until {c}"];
    let city = City::read("campus");
    for (order, plan) in [ORDERS[0], ORDERS[2], ORDERS[5]] {
        for (condition, holds) in CONDITIONS {
            let say = |form: &str| form.replace("{c}", condition).replace("{a}", order);
            all_mean(&city, &format!("if {holds} {{ {plan} }}"), IF.map(say));
            all_mean(&city, &format!("wait until {holds}, {plan}"), WHEN.map(say));
            all_mean(&city, &format!("until {holds} {{ {plan} }}"), UNTIL.map(say));
        }
    }
}

#[test]
fn any_order_is_repeated_however_that_is_said() {
    const TIMES: [&str; 7] = [
        "{} three times",
        "three times, {}",
        "{} 3 times",
        "do this three times: {}",
        "{}, and do that three times",
        "repeat three times: {}",
        "{} three times in a row",
    ];
    const SPAN: [&str; 4] = [
        "{} for a minute and a half",
        "for 90 seconds, {}",
        "{} for 1 minute and 30 seconds",
        "for one and a half minutes, {}",
    ];
    let city = City::read("campus");
    for (order, plan) in [ORDERS[2], ORDERS[5]] {
        all_mean(&city, &format!("repeat 3 {{ {plan} }}"), TIMES.map(|times| times.replace("{}", order)));
    }
    for (order, plan) in [ORDERS[2], ORDERS[6]] {
        all_mean(
            &city,
            &format!("until elapsed 90 {{ {plan} }}"),
            SPAN.map(|span| span.replace("{}", order)),
        );
    }
}

#[test]
fn quantities_are_the_same_in_any_unit() {
    let city = City::read("campus");
    let walks = ["20 metres", "twenty meters", "2000 cm", "0.02 km"];
    all_mean(&city, "go (0.0, 20.0)", walks.iter().map(|length| format!("walk {length} north")));
    let waits = [
        "90 seconds",
        "1.5 minutes",
        "one and a half minutes",
        "a minute and a half",
        "1 minute 30 seconds",
        "a minute and thirty seconds",
    ];
    all_mean(&city, "wait 90", waits.iter().map(|time| format!("wait for {time}")));
    let turns =
        ["90 degrees to the left", "left by 90°", "a quarter turn to the left", "to your left", "left"];
    all_mean(&city, "turn 90", turns.iter().map(|turn| format!("turn {turn}")));
}

#[test]
fn what_was_said_before_is_what_pronouns_stand_for() {
    let city = City::read("campus");
    let brought = [
        "the letter: bring it to Gus",
        "as for the letter, bring it to Gus",
        "you see the letter? bring it to Gus",
        "there is a letter near the library; take it to Gus",
        "Gus needs the letter",
        "the letter should go to Gus",
        "the letter must be brought to Gus",
        "I want the letter brought to Gus",
        "let Gus have the letter",
        "make sure Gus gets the letter",
        "fetch Gus the letter",
        "go to the kiosk, no, bring the letter to Gus",
        "bring the letter to Gus instead of the package",
        "don't go to the kiosk, bring the letter to Gus",
    ];
    let plan = "go letter, take letter, go gus, give gus";
    all_mean(&city, plan, brought.map(str::to_owned));
    let bought = [
        "get Gus a newspaper",
        "buy a newspaper for Gus",
        "Gus wants a newspaper",
        "bring Gus a newspaper from the kiosk",
        "Gus would like a newspaper, buy one and give it to him",
        "what about a newspaper? go and buy one and hand it to Gus",
    ];
    all_mean(&city, "go kiosk, buy newspaper, go gus, give gus", bought.map(str::to_owned));
}

#[test]
fn what_is_not_known_is_never_passed_over() {
    const UNKNOWN: [&str; 12] = [
        "tomorrow",
        "upside down",
        "with a spoon",
        "blindfolded",
        "without opening your eyes",
        "at five o'clock",
        "unless the pigs fly",
        "if Mars is in Leo",
        "until the cows come home",
        "on the moon",
        "but never touch the ground",
        "and juggle",
    ];
    let city = City::read("campus");
    for (order, _) in ORDERS {
        for unknown in UNKNOWN {
            let words = format!("{order} {unknown}");
            let got = meaning(&city, &words);
            assert!(got.is_err(), "{words:?} gave {got:?}");
        }
    }
}
