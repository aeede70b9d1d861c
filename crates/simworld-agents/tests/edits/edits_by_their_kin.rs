//! Turns of phrase by their kin: who is told of whatever he does, skies among other requests, what is kept away from something, what looks good in a
//! colour, and what who learns the language says: what must come of them, and what must not be read so.

use crate::city::City;
use crate::edits_common::{Asked, Verdict, come_to, verdict};

#[test]
fn who_is_told_of_is_meant_whatever_he_does() {
    come_to(
        "campus",
        &[
            (
                "Hana posts a lot of cards; put a letter box within five metres of her.",
                "add letter_box within hana 5",
            ),
            (
                "Hana watches birds, so stand a bird bath left of the tree nearest to her.",
                "add bird_bath left_of birch",
            ),
            ("Hana parks wherever she likes; put a cone near her.", "add cone near hana"),
            ("Poor Hana's all on her own, chuck a dog in beside her", "add dog next_to hana"),
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "Ada fancies a lie-down; a deck chair right next to her would be lovely.",
                "add deck_chair next_to ada",
            ),
            ("Ada she is thirsty, give drinking fountain near to her", "add drinking_fountain near ada"),
        ],
    );
    come_to("harbour", &[("Anna benches all her dates; put a cone near her.", "add cone near anna")]);
}

#[test]
fn weather_is_let_come_among_other_requests() {
    come_to(
        "harbour",
        &[
            (
                "Exchange Anna and Ben, call the dog Captain, and let fog roll in.",
                "swap anna ben + name rex 'Captain' + weather fog",
            ),
            ("Give me a foggy dawn over the water.", "weather fog & hour 6"),
            ("From the sky it must fall rain now.", "weather rain"),
        ],
    );
    come_to(
        "quarter",
        &[(
            "Remove the Kiosk, add a food cart next to the fountain and let fog roll in.",
            "remove kiosk + add food_cart next_to fountain + weather fog",
        )],
    );
    come_to(
        "oldtown",
        &[
            (
                "Let's have a clear sky at noon, and a parasol near the red chair against the glare.",
                "weather clear & hour 12 + add parasol near chair_b",
            ),
            (
                "Make it a rainy night, I need the right mood for the murder mystery.",
                "weather rain & hour 23",
            ),
        ],
    );
    come_to("campus", &[("I'd like rain and noon light at the same time.", "weather rain & hour 12")]);
}

#[test]
fn remarks_of_strangers_are_left_out_and_what_they_brought_is_put() {
    come_to(
        "campus",
        &[("Shrink the statue to half its size; the donors found it a little pompous.", "scale statue 0.5")],
    );
    come_to(
        "oldtown",
        &[(
            "The crew unloaded eleven cardboard boxes; show them near the van.",
            "add cardboard_box 11 near van",
        )],
    );
}

#[test]
fn what_is_kept_away_goes_and_is_painted() {
    come_to(
        "harbour",
        &[
            (
                "Light a campfire, but keep it at least 25 metres away from the diner.",
                "add campfire beyond diner 25",
            ),
            ("The bus would look dead good in green, wouldn't it? Go on then.", "paint bus green"),
            ("Me want small dog close to Anna.", "add small_dog near anna"),
            ("Museum has no bicycle outside, please to put one in front.", "add bicycle in_front_of museum"),
        ],
    );
    come_to(
        "quarter",
        &[
            ("I reckon the postbox would look ace in purple, so do it.", "paint postbox purple"),
            ("The red car, can you make that it is black?", "paint car_red black"),
            ("Kindly make to disappear the chair.", "remove chair"),
            ("Add a wheelie bn near the Old Bakry.", "add wheelie_bin near bakery"),
            ("A wee dog by the postbox wouldn't go amiss.", "add any dog next_to postbox"),
            ("the fountain needs a twin beside the kiosk", "copy fountain next_to kiosk"),
            ("Remove all oaks except those taller than 10 m.", "remove oak_1 oak_3"),
        ],
    );
    come_to(
        "campus",
        &[
            ("Black car would look better when it is orange, you do it please.", "paint car_2 orange"),
            ("Please you make one picnic table at side of the statue.", "add picnic_table next_to statue"),
            ("Fido is needing a kennel, it must stay beside him.", "add doghouse next_to fido"),
            (
                "Fido's dying to lie down right by the hydrant, so plonk him there.",
                "move fido next_to hydrant",
            ),
        ],
    );
    come_to(
        "oldtown",
        &[
            ("Have Eve gawp at the van for a change.", "face eve van"),
            ("Set the taxi on top of the taxi itself.", "! impossible"),
            ("Would be nice if the white truck became orange.", "paint van orange"),
            ("Who or what is Spot 7?", "describe robot"),
            ("Me, I am cold, so please one campfire close to Eve.", "add campfire near eve"),
        ],
    );
}

#[test]
fn what_two_more_sets_left_comes_to_the_same_as_its_kin() {
    come_to(
        "harbour",
        &[
            (
                "We shoot at dawn: I want fog, and a man and a woman near the lamp.",
                "weather fog & hour 6 + add man near lamp + add woman near lamp",
            ),
            (
                "We film at noon: we need rain, and a dog near the pine.",
                "weather rain & hour 12 + add any dog near pine",
            ),
            ("Put a doghouse next to the animal that is close to the cone.", "add doghouse next_to rex"),
            (
                "It would be very kind if one garbage truck come and stay near from the hydrant.",
                "add garbage_truck near hydrant",
            ),
            (
                "Rex must be bored all on his own, get him a small dog right by his side.",
                "add small_dog next_to rex",
            ),
            (
                "Anna must be so tired, bring her a deck chair right beside her.",
                "add deck_chair next_to anna",
            ),
            ("Paint the sailing boat green.", "! not found ~ boat"),
            ("Remove the sailing boat.", "! not found ~ boat"),
            ("Let's have the sun just coming up, you know, dawn.", "hour 6"),
            ("We'd like the sun going down.", "hour 20"),
            ("Add a grand piano beside the mailbox.", "! unknown thing ~ piano"),
        ],
    );
    come_to(
        "oldtown",
        &[
            ("Let fog roll in over the square.", "weather fog"),
            ("Let the snow fall over the old town.", "weather snow"),
            (
                "Dmitri looks knackered, get the poor fellow an armchair right beside him.",
                "add armchair next_to dmitri",
            ),
            ("A trio of tourists should gather around the traffic light.", "add tourist 3 near light"),
            ("Bruno wouldn't say no to a doghouse at his side.", "add doghouse next_to bruno"),
            ("Eve would never refuse a deck chair beside her.", "add deck_chair next_to eve"),
            (
                "Me, I like it more when the taxi has the colour green. You change it, please?",
                "paint taxi green",
            ),
            ("The taxi would look a million times better in pink.", "paint taxi pink"),
        ],
    );
    come_to(
        "campus",
        &[
            (
                "Make it rain and give Gus an umbrella - I mean, put one right beside him.",
                "weather rain + add umbrella next_to gus",
            ),
            ("I reckon the red scooter would look miles better in white.", "paint scooter white"),
            ("Pu a barbeqe besde the hegde", "add barbecue next_to hedge"),
            (
                "There ought to be a stone bench behind the place where students buy their soup.",
                "add stone_bench behind canteen",
            ),
            (
                "Put a bench behind the building where the locals usually get their salad.",
                "add any bench behind canteen",
            ),
            (
                "I'd like a solar panel on the roof of Curie Lab, just the one to begin with.",
                "add solar_panel on_top_of lab",
            ),
        ],
    );
    come_to(
        "quarter",
        &[
            ("The red bench would look smashing in purple, so go for it.", "paint bench_red purple"),
            ("Have a jogger pause near the cone, just for scale.", "add jogger near cone"),
            (
                "A student wants shade, so let one stand near the lime tree closest to the statue.",
                "add student near lime_2",
            ),
            ("Ada is needing a large dog who sits by her.", "add large_dog next_to ada"),
        ],
    );
}

#[test]
fn what_is_like_them_and_asks_for_nothing_changes_nothing() {
    leave(
        "quarter",
        &[
            "I don't think the red bench would look smashing in purple.",
            "Ada would refuse a large dog at her side.",
            "It would be bad if a dog came and sat near Ada.",
        ],
    );
    leave("oldtown", &["I like it more when the taxi has the colour green."]);
}

#[test]
fn nothing_is_done_where_nothing_is_asked_or_decided() {
    leave(
        "campus",
        &[
            // Nothing says which thing "it" is.
            "Hana frobnicates; put it near her.",
            "Hana frobnicates.",
        ],
    );
    leave(
        "harbour",
        &[
            "Anna's mother frobnicates; put a cone near her sister.",
            "I don't think the bus would look good in green.",
            "In my country is always a flagpole close to the museum.",
            "The crew unloaded eleven cardboard boxes.",
        ],
    );
}

/// That no sentence changes anything.
fn leave(city: &str, said: &[&str]) {
    let city = City::read(city);
    for words in said {
        let asked = Asked {
            set: "kin",
            family: "kin".to_owned(),
            words: (*words).to_owned(),
            meaning: String::new(),
        };
        let came = verdict(&city, &asked);
        assert!(!matches!(came, Verdict::WrongEdit(_)), "{words}: {came:?}");
    }
}
