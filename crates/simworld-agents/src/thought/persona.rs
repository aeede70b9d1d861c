//! Who an agent is, as its prompts say it.

use serde::{Deserialize, Serialize};

/// A character that shapes what an agent does.
pub trait Persona: Send {
    /// A sentence or a few in the second person: "You are Ada, a baker. You are patient."
    fn describe(&self) -> String;
}

impl Persona for String {
    fn describe(&self) -> String {
        self.clone()
    }
}

/// A name, a life and some traits.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Character {
    /// What one is called; nothing if empty.
    pub name: String,
    /// What one does: "a baker who opens at five".
    pub life: String,
    /// How one is: "patient", "curious".
    pub traits: Vec<String>,
}

impl Persona for Character {
    fn describe(&self) -> String {
        let mut parts = Vec::new();
        match (self.name.is_empty(), self.life.is_empty()) {
            (false, false) => parts.push(format!("You are {}, {}.", self.name, self.life)),
            (false, true) => parts.push(format!("You are {}.", self.name)),
            (true, false) => parts.push(format!("You are {}.", self.life)),
            (true, true) => {}
        }
        if !self.traits.is_empty() {
            parts.push(format!("You are {}.", self.traits.join(", ")));
        }
        parts.join(" ")
    }
}

impl Persona for crate::delivery::Persona {
    /// Traits beyond a quarter of their range, in words.
    fn describe(&self) -> String {
        let pairs = [
            (self.openness, "cautious", "curious"),
            (self.conscientiousness, "careless", "organised"),
            (self.extraversion, "reserved", "outgoing"),
            (self.agreeableness, "critical", "friendly"),
            (self.neuroticism, "confident", "nervous"),
        ];
        let word = |(value, low, high): (f64, &str, &str)| match value {
            value if value > 0.25 => Some(high.to_owned()),
            value if value < -0.25 => Some(low.to_owned()),
            _ => None,
        };
        let traits = pairs.into_iter().filter_map(word).collect();
        Character { traits, ..Character::default() }.describe()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn characters_read_as_sentences() {
        let ada = Character {
            name: "Ada".into(),
            life: "a baker who opens at five".into(),
            traits: vec!["patient".into(), "frugal".into()],
        };
        assert_eq!(ada.describe(), "You are Ada, a baker who opens at five. You are patient, frugal.");
        assert_eq!(Character::default().describe(), "");
        let courier = crate::delivery::Persona { neuroticism: -0.8, openness: 0.2, ..Default::default() };
        assert_eq!(courier.describe(), "You are confident.");
    }
}
