//! Sizes: "twice as big", "by 150 percent", "double the benches".

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference};
use super::super::lexer::{Lexeme, Token, lex};
use super::super::lexicon::longest_phrase;
use super::super::numbers;
use super::measures::{Extent, Size};
use super::parse::Reader;
use super::wish::Wish;

impl Reader<'_> {
    pub(super) fn sized(&mut self, end: usize, usual: f64) -> Result<Vec<Vec<Wish>>, PlanError> {
        let start = self.at;
        if let Some((what, share)) = self.by_a_share(start, end) {
            let factor = super::ratios::grown(share, usual > 1.0);
            let factor =
                factor.ok_or_else(|| self.not_understood("say by how much, and leave some of it"))?;
            self.at = end;
            return Ok(vec![vec![Wish::Scale { what, factor }]]);
        }
        if let Some(wish) = self.scaled(start, end) {
            self.at = end;
            return Ok(vec![vec![wish]]);
        }
        // "Shrink the statue by one metre".
        let metres = (start + 1..end).find_map(|at| {
            let by = longest_phrase(&self.lexemes[at..end], &["by"])?;
            let (metres, words) = numbers::length(&self.lexemes[at + by..end])?;
            (at + by + words == self.before_politeness(at, end)).then_some((at, metres))
        });
        if let Some((cut, metres)) = metres
            && let Ok(what) = self.things(start, cut)
        {
            self.at = end;
            let more = if usual < 1.0 { -metres } else { metres };
            return Ok(vec![vec![Wish::Resize { what, size: Size::More(Extent::Height, more) }]]);
        }
        // "Shrink the crate a little".
        let little = (start + 1..end).find(|at| {
            longest_phrase(
                &self.lexemes[*at..end],
                &["a little", "a bit", "slightly", "somewhat", "a little bit", "a tad", "a touch"],
            ) == Some(end - at)
        });
        let what = self.things(start, little.unwrap_or(end))?;
        self.at = end;
        Ok(vec![vec![Wish::Scale { what, factor: usual }]])
    }

    /// "Enlarge the mailbox by half" and "shrink it by 30 percent": things, and so much of what they are by which they are to be larger, or smaller.
    fn by_a_share(&self, start: usize, end: usize) -> Option<(Vec<Reference>, f64)> {
        let end = self.before_politeness(start, end);
        (start + 1..end).find_map(|cut| {
            let by = longest_phrase(&self.lexemes[cut..end], &["by", "in size by", "in height by"])?;
            let (share, words) = super::ratios::share(&self.lexemes[cut + by..end])?;
            let what = self.things(start, cut).ok().filter(|_| cut + by + words == end)?;
            Some((what, share))
        })
    }

    /// Things, and behind them a size.
    pub(super) fn scaled(&self, start: usize, end: usize) -> Option<Wish> {
        for cut in start + 1..end {
            let rest = &self.lexemes[cut..end];
            let number = factor_in_numbers(rest).filter(|(_, count)| cut + count == end);
            let factor = number.map(|(factor, _)| factor).or_else(|| super::predicates::size_of(rest));
            let Some(size) = factor.map(Size::Times).or_else(|| self.measure(cut, end)) else { continue };
            if let Ok(what) = self.things(start, cut) {
                return Some(match size {
                    Size::Times(factor) => Wish::Scale { what, factor },
                    size => Wish::Resize { what, size },
                });
            }
        }
        None
    }

    pub(super) fn double(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let begin = self.at - 1;
        let verb = (0..=begin).rev().find_map(|at| {
            let word = self.word(at)?;
            [("double", 2.0), ("triple", 3.0), ("halve", 0.5)].into_iter().find(|(name, _)| *name == word)
        });
        let factor = verb.map_or(2.0, |(_, factor)| factor);
        let of_number = self.word(begin) == Some("of") && self.word(begin - 1) == Some("number");
        let sized = self.word(begin) == Some("of") && !of_number;
        let start = self.at;
        // "... and double its size".
        let whose = longest_phrase(
            self.rest(end),
            &[
                "its size",
                "their size",
                "his size",
                "her size",
                "the size of it",
                "the size",
                "it in size",
                "its height",
            ],
        );
        if whose.is_some_and(|words| self.before_politeness(start, end) <= start + words) {
            let what = vec![Reference::to(super::super::clause::Target::It, "it".to_owned())];
            self.at = end;
            return Ok(vec![vec![Wish::Scale { what, factor }]]);
        }
        let what = self.one_to(end)?;
        let many = matches!(what.count, Count::All) || self.is_plural(start, end);
        if many && !sized && factor > 1.0 {
            return Ok(vec![vec![Wish::Multiply { what, times: factor as u32 }]]);
        }
        Ok(vec![vec![Wish::Scale { what: vec![what], factor }]])
    }

    pub(super) fn is_plural(&self, start: usize, end: usize) -> bool {
        let mut words = self.lexemes[start..end].iter().filter_map(|lexeme| match &lexeme.token {
            Token::Word(word) => Some(word.as_str()),
            _ => None,
        });
        // The noun is the first word that is in the plural of a class.
        words.any(|word| word.ends_with('s') && super::super::lexicon::category(&lex(word)).is_some())
    }
}

/// "By 150 percent", "by a factor of 1.5", "1.5 times".
pub(super) fn factor_in_numbers(lexemes: &[Lexeme]) -> Option<(f64, usize)> {
    let mut at = longest_phrase(
        lexemes,
        &["by a factor of", "by factor", "by", "to", "a factor of", "up by", "down by"],
    )
    .unwrap_or(0);
    let relative = longest_phrase(lexemes, &["by", "up by"]).is_some();
    let down = longest_phrase(lexemes, &["down by"]).is_some();
    let (mut number, count) = numbers::number(&lexemes[at..])?;
    at += count;
    if let Some(count) = longest_phrase(&lexemes[at..], &["and a half"]) {
        (number, at) = (number + 0.5, at + count);
    }
    if let Some(count) = longest_phrase(&lexemes[at..], &["percent", "%", "per cent"]) {
        at += count;
        let more = longest_phrase(&lexemes[at..], &["bigger", "larger", "taller"]);
        let less = longest_phrase(&lexemes[at..], &["smaller", "shorter"]);
        at += more.or(less).unwrap_or(0);
        let share = number / 100.0;
        let factor = match (more, less) {
            (_, Some(_)) => 1.0 - share,
            (Some(_), _) => 1.0 + share,
            _ if down => 1.0 - share,
            _ if relative => 1.0 + share,
            _ => share,
        };
        return Some((factor, at));
    }
    at += longest_phrase(
        &lexemes[at..],
        &[
            "times",
            "x",
            "times as big",
            "times bigger",
            "times the size",
            "times as large",
            "times its size",
            "times larger",
            "times as tall",
            "times taller",
            "times its current size",
            "times the current size",
            "times its present size",
            "times its height",
            "times as high",
            "times what it is",
            "times what it is now",
            "times its original size",
            "times the original size",
            "times as big as now",
            "times as big as it is",
            "times as big as it is now",
            "fold",
        ],
    )
    .unwrap_or(0);
    Some((number, at))
}
