//! Weather and hour as a scene is set by them: "a sea mist rolls in", "for the opening shot I want thick fog at first light", "enough of the bad
//! weather, clear the sky". The notation is that of [`super::turns`].
//!
//! They are tried only where a sentence was refused.

use super::retold::Turns;

/// Turns of phrase and what they mean, of one sentence each.
#[rustfmt::skip]
pub(super) const SET_SCENES: &Turns = &[
    // How a weather comes.
    ("O a|an|the|some|- sea|morning|evening|ground|river|harbour|coastal|sudden|cold|grey|white|autumn|winter|spring|summer|- Y rolls|roll|drifts|drift|creeps|creep|moves|sweeps|blows|sets|comes|closes|settles|descends|falls|arrives|begins|starts|breaks|gathers|hangs|pours in|up|down|out|over|across|from|- the|our|this|- sea|harbour|quay|quayside|town|city|campus|quarter|scene|water|bay|place|streets|square|-", "O make it Y"),
    // What it is for.
    ("O for|in|during the|this|that|our|my|a|- opening|first|next|last|final|closing|establishing|main|big|new|second|third|title|love|night|chase|crowd|- shot|shots|scene|scenes|film|movie|story|picture|pictures|photo|photos|painting|sequence|take|chapter|act|episode|video|clip|finale|intro|ending|postcard|poster|cover|trailer|play|show ,|- P", "O P"),
    // What there is enough of.
    ("i|we|im|were|ive|weve|- am|are|have|had|- had|- enough|fed|sick|tired|away|done of|with|up|- of|with|- the|this|that|all|such|- the|this|that|- bad|awful|foul|nasty|horrible|dreadful|terrible|miserable|lousy|dreary|gloomy|grey|gray|dull|rotten|ghastly|wretched|filthy weather", "make it clear"),
    ("i|we|im|were|ive|weve|- am|are|have|had|- had|- enough|fed|sick|tired|away|done of|with|up|- of|with|- the|this|that|all|such|- the|this|that|- bad|awful|foul|nasty|horrible|dreadful|terrible|miserable|lousy|dreary|gloomy|grey|gray|dull|rotten|ghastly|wretched|filthy weather ,|and|- clear B", "clear B"),
    ("i|we|im|were|ive|weve|- am|are|have|had|- had|- enough|fed|sick|tired|away|done of|with|up|- of|with|- the|this|that|all|such|- the|this|that|- bad|awful|foul|nasty|horrible|dreadful|terrible|miserable|lousy|dreary|gloomy|grey|gray|dull|rotten|ghastly|wretched|filthy weather ,|and|- let B", "let B"),
    ("i|we|im|were|ive|weve|- am|are|have|had|- had|- enough|fed|sick|tired|away|done of|with|up|- of|with|- the|this|that|all|such|- the|this|that|- bad|awful|foul|nasty|horrible|dreadful|terrible|miserable|lousy|dreary|gloomy|grey|gray|dull|rotten|ghastly|wretched|filthy weather ,|and|- make it B", "make it B"),
    ("enough of|with the|this|that|- rain|drizzle|raining|showers|downpour", "stop the rain"),
    ("enough of|with the|this|that|- snow|snowing|snowfall|blizzard", "stop the snow"),
    ("enough of|with the|this|that|- fog|mist|haze", "stop the fog"),
];
