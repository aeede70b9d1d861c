//! JSON schemas as models get them, and the check of an answer against the very schema that was sent.
//!
//! Servers honour schemas more or less; what comes back is checked here as if none had been sent. The schemas are made of
//! few things that all servers know: objects whose fields are all required, arrays, enums of texts, bounded whole
//! numbers, bounded texts, `anyOf`, and `$ref` into `$defs`.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};
use thiserror::Error;

/// The deepest nesting of a schema that is followed.
const DEEPEST: usize = 64;
/// The most alternatives that a message lists.
const LISTED: usize = 24;

/// Where an answer departs from its schema, and how.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}{reason}", at(path))]
pub struct Mismatch {
    /// The way to the place: `steps[2].seat`; empty for the whole.
    pub path: String,
    /// What is wrong there, and what would be right.
    pub reason: String,
}

fn at(path: &str) -> String {
    if path.is_empty() { "the answer ".to_owned() } else { format!("{path} ") }
}

/// An object with these fields, all required, and no others.
pub fn object<'a>(fields: impl IntoIterator<Item = (&'a str, Value)>) -> Value {
    let properties: Map<String, Value> =
        fields.into_iter().map(|(name, schema)| (name.to_owned(), schema)).collect();
    let required: Vec<&String> = properties.keys().collect();
    json!({ "type": "object", "required": required, "properties": properties, "additionalProperties": false })
}

/// One of these texts.
pub fn one_of<T: Into<String>>(texts: impl IntoIterator<Item = T>) -> Value {
    let texts: Vec<String> = texts.into_iter().map(Into::into).collect();
    json!({ "type": "string", "enum": texts })
}

/// A whole number within bounds.
pub fn integer(low: i64, high: i64) -> Value {
    json!({ "type": "integer", "minimum": low, "maximum": high })
}

/// A text of at most that many characters.
pub fn words(most: usize) -> Value {
    json!({ "type": "string", "maxLength": most })
}

/// A list of so many items.
pub fn list(item: &Value, least: usize, most: usize) -> Value {
    json!({ "type": "array", "items": item, "minItems": least, "maxItems": most })
}

/// Something that fits one of these.
pub fn any_of(branches: Vec<Value>) -> Value {
    match <[Value; 1]>::try_from(branches) {
        Ok([only]) => only,
        Err(branches) => json!({ "anyOf": branches }),
    }
}

/// What stands under a name in the schema's `$defs`.
pub fn defined(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// The value in a text: alone, in a fenced block, or after words that hold no brace.
///
/// # Errors
/// There is none, or something else follows it.
pub fn value_in(text: &str) -> Result<Value, Mismatch> {
    let begins = text.find(['{', '[']).unwrap_or(0);
    let body = text[begins..].trim().trim_end_matches('`').trim_end();
    serde_json::from_str(body)
        .map_err(|error| Mismatch { path: String::new(), reason: format!("is no JSON: {error}") })
}

/// A whole number, also where it is written as `-0`, `5.0` or `5e1`, which JSON schemas take for whole.
pub fn whole(number: &Value) -> Option<i64> {
    /// From here on a float has no neighbour that differs by one.
    const EXACT: f64 = 9_007_199_254_740_992.0;
    let float = |number: f64| (number.fract() == 0.0 && number.abs() < EXACT).then_some(number as i64);
    number.as_i64().or_else(|| number.as_f64().and_then(float))
}

/// Checks an answer against a schema made of what this module makes.
///
/// # Errors
/// The first place where it departs; of alternatives told apart by a field of one value, that of the one it names.
pub fn check(answer: &Value, schema: &Value) -> Result<(), Mismatch> {
    Checker { whole: schema }.check(answer, schema, &mut String::new(), 0)
}

struct Checker<'a> {
    whole: &'a Value,
}

impl<'a> Checker<'a> {
    fn check(
        &self,
        answer: &Value,
        schema: &'a Value,
        path: &mut String,
        depth: usize,
    ) -> Result<(), Mismatch> {
        let schema = self.resolved(schema, path)?;
        if depth > DEEPEST {
            return wrong(path, format!("is nested deeper than {DEEPEST}"));
        }
        if let Some(branches) = schema.get("anyOf").and_then(Value::as_array) {
            return self.check_any(answer, branches, path, depth);
        }
        match schema.get("type").and_then(Value::as_str) {
            Some("object") => self.check_object(answer, schema, path, depth),
            Some("array") => self.check_array(answer, schema, path, depth),
            Some("string") => check_text(answer, schema, path),
            Some("integer") => check_integer(answer, schema, path),
            _ => wrong(path, "has a schema that cannot be checked".to_owned()),
        }
    }

    /// The schema that a `$ref` stands for; one ref never leads to another here, but a few hops do no harm.
    fn resolved(&self, schema: &'a Value, path: &str) -> Result<&'a Value, Mismatch> {
        let mut schema = schema;
        for _ in 0..DEEPEST {
            let Some(target) = schema.get("$ref").and_then(Value::as_str) else { return Ok(schema) };
            let Some(found) = target.strip_prefix('#').and_then(|pointer| self.whole.pointer(pointer)) else {
                break;
            };
            schema = found;
        }
        wrong(path, "has a schema that refers to nothing".to_owned())
    }

    fn check_any(
        &self,
        answer: &Value,
        branches: &'a [Value],
        path: &mut String,
        depth: usize,
    ) -> Result<(), Mismatch> {
        let mut tags = Vec::new();
        // What is wrong by the branch that the answer names, and by others.
        let (mut meant, mut last) = (None, None);
        let length = path.len();
        for branch in branches {
            path.truncate(length);
            let branch = self.resolved(branch, path)?;
            match tag(branch) {
                Some((name, value)) if answer.is_object() => {
                    tags.push((name, value));
                    if answer.get(name).and_then(Value::as_str) == Some(value) {
                        match self.check(answer, branch, path, depth + 1) {
                            Ok(()) => return Ok(()),
                            Err(mismatch) => meant = Some(mismatch),
                        }
                    }
                }
                _ => match self.check(answer, branch, path, depth + 1) {
                    Ok(()) => return Ok(()),
                    Err(mismatch) => last = Some(mismatch),
                },
            }
        }
        path.truncate(length);
        if let Some(mismatch) = meant {
            return Err(mismatch);
        }
        tags.dedup();
        match (tags.first(), last) {
            (Some((name, _)), _) => {
                let values: Vec<&str> = tags.iter().map(|(_, value)| *value).collect();
                let given = answer.get(name).map_or("is missing".to_owned(), |given| format!("is {given}"));
                wrong(&join(path, name), format!("{given}: give one of {}", listed(&values)))
            }
            (None, Some(mismatch)) => Err(mismatch),
            (None, None) => wrong(path, "fits nothing that is possible here".to_owned()),
        }
    }

    fn check_object(
        &self,
        answer: &Value,
        schema: &'a Value,
        path: &mut String,
        depth: usize,
    ) -> Result<(), Mismatch> {
        let Some(fields) = answer.as_object() else { return wrong(path, "must be an object".to_owned()) };
        let Some(properties) = schema.get("properties").and_then(Value::as_object) else {
            return wrong(path, "has a schema without fields".to_owned());
        };
        if let Some(stranger) = fields.keys().find(|name| !properties.contains_key(*name)) {
            let known: Vec<&str> = properties.keys().map(String::as_str).collect();
            let stranger: String = stranger.chars().take(40).collect();
            return wrong(
                path,
                format!("has an unknown field {stranger:?}: the fields are {}", listed(&known)),
            );
        }
        for (name, field) in properties {
            let Some(value) = fields.get(name) else {
                return wrong(path, format!("lacks the field {name:?}"));
            };
            let length = path.len();
            *path = join(path, name);
            self.check(value, field, path, depth + 1)?;
            path.truncate(length);
        }
        Ok(())
    }

    fn check_array(
        &self,
        answer: &Value,
        schema: &'a Value,
        path: &mut String,
        depth: usize,
    ) -> Result<(), Mismatch> {
        let Some(items) = answer.as_array() else { return wrong(path, "must be a list".to_owned()) };
        let bound = |name: &str| schema.get(name).and_then(Value::as_u64).unwrap_or(0) as usize;
        let (least, most) = (bound("minItems"), bound("maxItems"));
        if !(least..=most).contains(&items.len()) {
            return wrong(path, format!("has {} items: give {least} to {most}", items.len()));
        }
        let item_schema = schema.get("items").unwrap_or(&Value::Null);
        for (index, item) in items.iter().enumerate() {
            let length = path.len();
            // Writing to a text never fails.
            let _ = write!(path, "[{index}]");
            self.check(item, item_schema, path, depth + 1)?;
            path.truncate(length);
        }
        Ok(())
    }
}

fn check_text(answer: &Value, schema: &Value, path: &str) -> Result<(), Mismatch> {
    let Some(text) = answer.as_str() else { return wrong(path, "must be a text".to_owned()) };
    if let Some(allowed) = schema.get("enum").and_then(Value::as_array) {
        if allowed.iter().any(|allowed| allowed.as_str() == Some(text)) {
            return Ok(());
        }
        let names: Vec<&str> = allowed.iter().filter_map(Value::as_str).collect();
        let given: String = text.chars().take(60).collect();
        return wrong(path, format!("is {given:?}: give one of {}", listed(&names)));
    }
    let most = schema.get("maxLength").and_then(Value::as_u64).unwrap_or(u64::MAX);
    let length = text.chars().count() as u64;
    if length > most {
        return wrong(path, format!("has {length} characters: give at most {most}"));
    }
    Ok(())
}

fn check_integer(answer: &Value, schema: &Value, path: &str) -> Result<(), Mismatch> {
    let bound = |name: &str, otherwise| schema.get(name).and_then(Value::as_i64).unwrap_or(otherwise);
    let (low, high) = (bound("minimum", i64::MIN), bound("maximum", i64::MAX));
    match whole(answer) {
        Some(number) if (low..=high).contains(&number) => Ok(()),
        _ => wrong(path, format!("must be a whole number from {low} to {high}")),
    }
}

/// The field of an object's schema that has one value only, by which alternatives are told apart.
fn tag(schema: &Value) -> Option<(&str, &str)> {
    schema.get("properties")?.as_object()?.iter().find_map(|(name, field)| {
        match field.get("enum")?.as_array()?.as_slice() {
            [only] => Some((name.as_str(), only.as_str()?)),
            _ => None,
        }
    })
}

fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}

fn listed(names: &[&str]) -> String {
    let shown = names.iter().take(LISTED).copied().collect::<Vec<_>>().join(", ");
    if names.len() > LISTED { format!("{shown} and {} more", names.len() - LISTED) } else { shown }
}

fn wrong<T>(path: &str, reason: String) -> Result<T, Mismatch> {
    Err(Mismatch { path: path.to_owned(), reason })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walk() -> Value {
        let mut schema = object([
            (
                "steps",
                list(
                    &any_of(vec![
                        object([("act", one_of(["turn"])), ("degrees", integer(-180, 180))]),
                        object([("act", one_of(["say"])), ("to", defined("people")), ("words", words(5))]),
                    ]),
                    1,
                    2,
                ),
            ),
            ("with", any_of(vec![one_of(["nobody"]), list(&defined("people"), 1, 2)])),
        ]);
        schema["$defs"] = json!({ "people": one_of(["#1", "#2"]) });
        schema
    }

    fn fault(answer: &str) -> String {
        check(&value_in(answer).unwrap(), &walk()).unwrap_err().to_string()
    }

    #[test]
    fn what_conforms_passes() {
        for answer in [
            r#"{"steps": [{"act": "turn", "degrees": -180}], "with": "nobody"}"#,
            r##"Here: ```{"steps": [{"act": "say", "to": "#2", "words": "hello"}], "with": ["#1", "#1"]}```"##,
        ] {
            check(&value_in(answer).unwrap(), &walk()).unwrap();
        }
    }

    #[test]
    fn what_does_not_is_named_with_its_place() {
        let with = |step: &str| fault(&format!(r#"{{"steps": [{step}], "with": "nobody"}}"#));
        assert_eq!(
            with(r#"{"act": "turn", "degrees": 181}"#),
            "steps[0].degrees must be a whole number from -180 to 180"
        );
        assert_eq!(with(r#"{"act": "turn", "degrees": 9e3}"#), with(r#"{"act": "turn", "degrees": 1.5}"#));
        assert_eq!(with(r#"{"act": "fly"}"#), "steps[0].act is \"fly\": give one of turn, say");
        assert!(with(r#"{"degrees": 3}"#).starts_with("steps[0].act is missing"));
        let stranger = r##"{"act": "say", "to": "#3", "words": "hello"}"##;
        assert_eq!(with(stranger), "steps[0].to is \"#3\": give one of #1, #2");
        assert!(with(r##"{"act": "say", "to": "#1", "words": "hello!"}"##).contains("at most 5"));
        assert!(with(r#"{"act": "turn", "degrees": 1, "fast": true}"#).contains("unknown field \"fast\""));
        assert!(with(r#"{"act": "turn"}"#).contains("lacks the field \"degrees\""));
        assert!(with("7").contains("steps[0]"));
        assert!(fault(r#"{"steps": [], "with": "nobody"}"#).contains("give 1 to 2"));
        assert!(
            fault(r#"{"steps": [{"act": "turn", "degrees": 1}], "with": []}"#).contains("with has 0 items")
        );
        assert!(value_in(r#"{"steps": 9E490}"#).is_err() && value_in("go").is_err());
        assert!(value_in(r"{} {}").is_err(), "of two answers neither is meant");
    }

    #[test]
    fn whole_numbers_may_be_written_as_others() {
        for (written, number) in
            [("-0", Some(0)), ("5.0", Some(5)), ("5e1", Some(50)), ("5.5", None), ("1e300", None)]
        {
            assert_eq!(whole(&value_in(&format!("[{written}]")).unwrap()[0]), number, "{written}");
        }
    }

    #[test]
    fn a_schema_of_other_things_lets_nothing_pass() {
        for schema in [json!({}), json!({"type": "number"}), defined("nowhere"), json!({"$ref": "#"})] {
            assert!(check(&json!(1), &schema).is_err(), "{schema}");
        }
    }
}
