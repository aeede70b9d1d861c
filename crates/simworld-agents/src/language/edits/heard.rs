//! A sentence from its words to its wishes; and once more without what in it asks for nothing, where it was refused.

use simworld_core::scene::Scene;

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::longest;
use super::super::names::Names;
use super::super::parser::shortened;
use super::super::{LONGEST_SENTENCE, RANGE, hearing};
use super::attempts::{is_known, is_nowhere, wishes_of};
use super::memo::Memo;
use super::parse::{Reader, UNDERSTOOD};
use super::plainly::put_plainly;
use super::resolve::Finder;
use super::stages::stages;
use super::wish::Wish;
use super::words::{WAYS, Way};
use super::{
    Focus, Reading, chatter, dress_new, gone_by_name, gone_once, made_once, named_in_full, nth,
    paint_at_once, shades, slips, statements, texts, view_of,
};
use crate::editing::{EditError, Stock};

/// Reads a sentence; names are those of the scene. What is refused as it stands is heard anew without what in it asks for nothing.
pub(crate) fn read(
    words: &str,
    scene: &dyn Scene,
    stock: &Stock,
    focus: &Focus,
) -> Result<Reading, EditError> {
    if words.chars().count() > LONGEST_SENTENCE {
        let hint = format!("say it in at most {LONGEST_SENTENCE} characters");
        return Err(EditError::NotUnderstood { words: shortened(words), fragment: String::new(), hint });
    }
    let mut heard = hearing::hear(words, None);
    let begins_with_place = longest(&heard, &WAYS).is_some_and(|(way, _)| matches!(way, Way::To(_)));
    let tells_place = statements::tells_place(&heard);
    let ear = Ear { words, scene, stock, focus, begins_with_place, tells_place };
    shades::in_plain_words(words, &mut heard);
    if texts::asks_for_words(&heard) {
        let hint = UNDERSTOOD.to_owned();
        return Err(EditError::NotUnderstood { words: shortened(words), fragment: shortened(words), hint });
    }
    // What is said in one go has nothing that could be left out, nor that takes up anything said before.
    let last = heard.iter().rposition(|lexeme| !is_mark(lexeme)).unwrap_or(0);
    let in_one_go = !heard[..last].iter().any(|lexeme| is_mark(lexeme) || chatter::begins_reason(lexeme));
    if !in_one_go && let Some(read) = ear.taken_up(&heard) {
        return read;
    }
    let read = ear.read(heard.clone());
    if ear.is_granted(&read) {
        return read;
    }
    let read = if in_one_go { read } else { ear.without_chatter(heard.clone(), read) };
    let read = stages()
        .into_iter()
        .fold(read, |read, stage| if ear.is_granted(&read) { read } else { stage(&ear, &heard, read) });
    match read {
        Ok(reading) if ear.loses_place(&reading) => Err(EditError::NotUnderstood {
            words: shortened(words),
            fragment: String::new(),
            hint: "say where it is to go".to_owned(),
        }),
        Err(EditError::NotFound { wanted, near }) => {
            Err(EditError::NotFound { wanted: named_in_full::named(wanted, &heard, stock), near })
        }
        read => read,
    }
}

/// A sentence, and the scene in which it is heard.
#[derive(Clone, Copy)]
pub(super) struct Ear<'a> {
    pub(super) words: &'a str,
    pub(super) scene: &'a dyn Scene,
    pub(super) stock: &'a Stock,
    pub(super) focus: &'a Focus,
    /// Whether the sentence begins with a place, so that what is made stands nowhere else.
    begins_with_place: bool,
    /// Whether any of its parts does, so that something that is made stands somewhere.
    pub(super) tells_place: bool,
}

impl<'a> Ear<'a> {
    /// The names of the scene, and of what was made in words that were heard.
    pub(super) fn names(&self, heard: &[Lexeme]) -> Names<'a> {
        Names::new(self.scene, self.focus.from, RANGE).with_made(heard, &self.stock.catalogue)
    }
}

impl Ear<'_> {
    /// The wishes of what was heard, or of some of it.
    pub(super) fn read(&self, mut lexemes: Vec<Lexeme>) -> Result<Reading, EditError> {
        let Self { words, scene, stock, focus, .. } = *self;
        let view = view_of(scene, focus);
        let names = Names::new(scene, focus.from, RANGE);
        put_plainly(words, &mut lexemes, &names, (stock, &focus.streets));
        let names = names.with_made(&lexemes, &stock.catalogue);
        let first = nth::first_of(&mut lexemes);
        let memo = Memo::default();
        let reader =
            Reader { words, lexemes: &lexemes, names: &names, view: &view, memo: &memo, at: 0, depth: 0 };
        let nearest = reader.with_nearest_to_street();
        let reader = Reader { lexemes: nearest.as_deref().unwrap_or(&lexemes), ..reader };
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let topics = reader.with_topics(&finder);
        let reader = Reader { lexemes: topics.as_deref().unwrap_or(reader.lexemes), ..reader };
        let pointed = reader.with_what_was_pointed_at();
        let reader = Reader { lexemes: pointed.as_deref().unwrap_or(reader.lexemes), ..reader };
        let numbered = reader.with_number();
        let reader = Reader { lexemes: numbered.as_deref().unwrap_or(reader.lexemes), ..reader };
        let stood = reader.with_old_places(&finder);
        let reader = Reader { lexemes: stood.as_deref().unwrap_or(reader.lexemes), ..reader };
        let originals = reader.with_originals(&finder);
        let reader = Reader { lexemes: originals.as_deref().unwrap_or(reader.lexemes), ..reader };
        let before = reader.with_what_was_there(&finder);
        let reader = Reader { lexemes: before.as_deref().unwrap_or(reader.lexemes), ..reader };
        let left = reader.with_what_is_left(&finder);
        let reader = Reader { lexemes: left.as_deref().unwrap_or(reader.lexemes), ..reader };
        let several = reader.with_several_nearest(&finder);
        let reader = Reader { lexemes: several.as_deref().unwrap_or(reader.lexemes), ..reader };
        let compared = reader.with_compared(&finder);
        let reader = Reader { lexemes: compared.as_deref().unwrap_or(reader.lexemes), ..reader };
        let (mut wishes, held) = wishes_of(reader, scene, stock, focus)?;
        let said_first = held.as_ref().and_then(|_| wishes.first().cloned());
        if first.is_some_and(|first| !nth::begin(&mut wishes, first)) {
            return Err(reader.not_understood("say of what every second one is meant").into());
        }
        dress_new(&mut wishes);
        if focus.it.is_none() {
            gone_by_name(&mut wishes);
        }
        gone_once(&mut wishes);
        made_once(&mut wishes);
        paint_at_once(&mut wishes, &finder);
        // What was worked out stands for the first wish only while that is as it was.
        let held = held.filter(|_| wishes.first() == said_first.as_ref());
        Ok(Reading { words: words.to_owned(), wishes, held, any_of: focus.any_of })
    }

    /// Whether a sentence is understood, somebody has what it asks for, and what it is about first is there; or whether what is wrong with it
    /// is something else.
    pub(super) fn is_granted(&self, read: &Result<Reading, EditError>) -> bool {
        match read {
            Ok(reading) if self.loses_place(reading) => false,
            // What was found to be granted while it was read is not worked out anew.
            Ok(reading) => {
                reading.held.is_some() || reading.lacking(self.stock).is_empty() && !self.is_missing(reading)
            }
            Err(refused) => !matches!(refused, EditError::NotUnderstood { .. } | EditError::NotFound { .. }),
        }
    }

    /// Whether something new stands nowhere though a place was told.
    fn loses_place(&self, reading: &Reading) -> bool {
        let mut made =
            reading.wishes.iter().flatten().filter(|wish| matches!(wish, Wish::Add { .. })).peekable();
        let makes = made.peek().is_some();
        makes
            && (self.tells_place && made.clone().all(is_nowhere)
                || self.begins_with_place && made.any(is_nowhere))
    }

    /// Whether what the first wish is about is not there. What later wishes are about may be made by earlier ones.
    pub(super) fn is_missing(&self, reading: &Reading) -> bool {
        let Self { scene, stock, focus, .. } = *self;
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let missing = |wish: &Wish| matches!(finder.edits(wish), Err(EditError::NotFound { .. }));
        reading.wishes.first().is_some_and(|readings| readings.iter().all(missing))
    }

    /// The sentence without what in it asks for nothing, if that is granted; or else the answer that says most.
    pub(super) fn without_chatter(
        &self,
        mut heard: Vec<Lexeme>,
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        let Self { words, scene, stock, focus, .. } = *self;
        let names = self.names(&heard);
        slips::correct(words, &mut heard, &names, stock, &focus.streets);
        let (view, memo) = (view_of(scene, focus), Memo::default());
        let reader =
            Reader { words, lexemes: &heard, names: &names, view: &view, memo: &memo, at: 0, depth: 0 };
        let mut answer = None;
        for way in reader.without_chatter(&|wish: &Wish| is_known(wish, stock, false)) {
            let anew = self.read(way.lexemes);
            // What was left out may have said where.
            let stands_nowhere = |anew: &Reading| anew.wishes.iter().flatten().any(is_nowhere);
            if way.named && anew.as_ref().is_ok_and(stands_nowhere) {
                continue;
            }
            if self.is_granted(&anew) {
                return anew;
            }
            if answer.is_none() && !matches!(anew, Err(EditError::NotUnderstood { .. })) {
                answer = Some(anew);
            }
        }
        match answer {
            Some(answer) if matches!(read, Err(EditError::NotUnderstood { .. })) => answer,
            _ => read,
        }
    }
}
