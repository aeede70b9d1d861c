//! A sentence from its words to its wishes; and once more without what in it asks for nothing, where it was refused.

use simworld_core::scene::Scene;

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::longest;
use super::super::names::Names;
use super::super::parser::shortened;
use super::super::streets::StreetNames;
use super::super::{LONGEST_SENTENCE, RANGE, hearing};
use super::attempts::{is_known, is_nowhere, wishes_of};
use super::memo::Memo;
use super::parse::{Reader, UNDERSTOOD};
use super::resolve::Finder;
use super::wish::Wish;
use super::words::{WAYS, Way};
use super::{
    Focus, Reading, anew, beforehand, breaks, but_me, casual, chatter, doings, doubted, dress_new, facing,
    forms, gone_by_name, gone_once, headings, hesitations, homophones, lastly, made_once, margins, meant,
    narrowed, nth, others, paint_at_once, passing, periphrases, phrased, placed, plain, precautions,
    presence, remarked, repairs, respelt, retold, rows, sells_both, shades, sky_stated, slips, spared,
    spoken, statements, talk, talked, texts, unusual, unusual_first, view_of, which, whole, withdrawn,
    wording,
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
    let stages = [
        Ear::across_sentences,
        Ear::in_other_words,
        Ear::placed,
        Ear::told_anew,
        Ear::told_unusually,
        Ear::without_statements,
        Ear::talked,
        Ear::with_what_is_named,
    ];
    let read = stages
        .into_iter()
        .fold(read, |read, stage| if ear.is_granted(&read) { read } else { stage(&ear, &heard, read) });
    match read {
        Ok(reading) if ear.loses_place(&reading) => Err(EditError::NotUnderstood {
            words: shortened(words),
            fragment: String::new(),
            hint: "say where it is to go".to_owned(),
        }),
        read => read,
    }
}

/// A sentence, and the scene in which it is heard.
#[derive(Clone, Copy)]
struct Ear<'a> {
    words: &'a str,
    scene: &'a dyn Scene,
    stock: &'a Stock,
    focus: &'a Focus,
    /// Whether the sentence begins with a place, so that what is made stands nowhere else.
    begins_with_place: bool,
    /// Whether any of its parts does, so that something that is made stands somewhere.
    tells_place: bool,
}

impl<'a> Ear<'a> {
    /// The names of the scene, and of what was made in words that were heard.
    fn names(&self, heard: &[Lexeme]) -> Names<'a> {
        Names::new(self.scene, self.focus.from, RANGE).with_made(heard, &self.stock.catalogue)
    }
}

impl Ear<'_> {
    /// The wishes of what was heard, or of some of it.
    fn read(&self, mut lexemes: Vec<Lexeme>) -> Result<Reading, EditError> {
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
    fn is_granted(&self, read: &Result<Reading, EditError>) -> bool {
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
    fn is_missing(&self, reading: &Reading) -> bool {
        let Self { scene, stock, focus, .. } = *self;
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let missing = |wish: &Wish| matches!(finder.edits(wish), Err(EditError::NotFound { .. }));
        reading.wishes.first().is_some_and(|readings| readings.iter().all(missing))
    }

    /// The sentence without what in it asks for nothing, if that is granted; or else the answer that says most.
    fn without_chatter(
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

impl Ear<'_> {
    /// The sentence as it may have been meant, if that is granted; or else what is wrong with it.
    fn in_other_words(
        &self,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        let Self { words, stock, focus, .. } = *self;
        let names = self.names(heard);
        self.first_granted(lastly::ways(words, heard, &names, stock, focus), read)
    }

    /// As [`Self::in_other_words`], by questions in other words and by scenes that are set.
    fn told_anew(&self, heard: &[Lexeme], read: Result<Reading, EditError>) -> Result<Reading, EditError> {
        let Self { words, stock, focus, .. } = *self;
        let names = self.names(heard);
        self.first_granted(anew::ways(words, heard, &names, stock, focus), read)
    }

    /// As [`Self::in_other_words`], by turns that few use, conditions on doors, and what is said again by a part of it.
    fn told_unusually(
        &self,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        let Self { words, stock, focus, .. } = *self;
        let names = self.names(heard);
        self.first_granted(unusual::ways(words, heard, &names, stock, focus), read)
    }

    /// The first of some ways to say a sentence that is granted; or else what is wrong with it.
    fn first_granted(
        &self,
        ways: Vec<Vec<Lexeme>>,
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        for way in ways {
            let anew = self.read(way.clone());
            let anew = if self.is_granted(&anew) { anew } else { self.without_chatter(way, anew) };
            if self.is_granted(&anew) {
                return anew;
            }
        }
        read
    }

    /// As [`Self::in_other_words`], by where things stand that are told round about.
    fn placed(&self, heard: &[Lexeme], read: Result<Reading, EditError>) -> Result<Reading, EditError> {
        let Self { words, stock, focus, .. } = *self;
        let names = self.names(heard);
        let spelt = slips::corrected(words, heard, &names, stock, &focus.streets);
        let placed = [heard, &spelt[..]].map(|said| placed::ways(words, said, &names)).concat();
        placed.into_iter().map(|way| self.read(way)).find(|anew| self.is_granted(anew)).unwrap_or(read)
    }

    /// The sentence without the statements beside its request, in any of the other ways.
    fn without_statements(
        &self,
        heard: &[Lexeme],
        mut read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        let names = self.names(heard);
        let is_open = |refused: &EditError| {
            matches!(refused, EditError::NotUnderstood { .. } | EditError::NotFound { .. })
        };
        let mut asked = None;
        let left = statements::with_what_was_left(heard);
        for way in left.into_iter().chain(statements::without(heard, &names)) {
            if asked.is_none() && !self.tells_place {
                asked = Some(self.read(way.clone())).filter(|read| !read.as_ref().is_err_and(is_open));
            }
            let otherwise = lastly::in_other_words(&way);
            read = self.first_granted(vec![way.clone(), otherwise], read);
            for stage in [Self::placed, Self::told_anew] {
                if self.is_granted(&read) {
                    return read;
                }
                read = stage(self, &way, read);
            }
        }
        // What somebody asks for and nobody has says more than that what he told of is not there.
        match asked {
            Some(asked) if !self.is_granted(&read) => asked,
            _ => read,
        }
    }
}

impl Ear<'_> {
    /// The sentence as its parts take one another up, where it would be misread as it stands and is granted so; or which of several is meant
    /// must be asked.
    fn taken_up(&self, heard: &[Lexeme]) -> Option<Result<Reading, EditError>> {
        let ways = self.across(heard, true);
        let granted = |read: &Result<Reading, EditError>| read.is_ok() && self.is_granted(read);
        let found = ways.into_iter().map(|way| self.read(way)).find(granted);
        found.or_else(|| self.undecided(heard).map(Err))
    }

    /// What is to be asked where one of several is meant and nothing decides which.
    fn undecided(&self, heard: &[Lexeme]) -> Option<EditError> {
        let Self { words, scene, stock, focus, .. } = *self;
        let names = self.names(heard);
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let (view, memo) = (view_of(scene, focus), Memo::default());
        let reader =
            Reader { words, lexemes: heard, names: &names, view: &view, memo: &memo, at: 0, depth: 0 };
        reader.undecided(&finder)
    }

    /// As [`Self::in_other_words`], by what one sentence asks for in the words of another.
    fn across_sentences(
        &self,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        self.first_granted(self.across(heard, false), read)
    }

    /// Ways in which the parts of a sentence take one another up, as it was heard and as it is spelt; those that would be misread or the others.
    fn across(&self, heard: &[Lexeme], misread: bool) -> Vec<Vec<Lexeme>> {
        let Self { words, scene, stock, focus, .. } = *self;
        let names = self.names(heard);
        let spelt = slips::corrected(words, heard, &names, stock, &focus.streets);
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let (view, memo) = (view_of(scene, focus), Memo::default());
        let reader =
            Reader { words, lexemes: &spelt, names: &names, view: &view, memo: &memo, at: 0, depth: 0 };
        let ways = |reader: &Reader<'_>| {
            if misread { reader.across_first(&finder) } else { reader.across_later(&finder) }
        };
        let mut told = ways(&reader);
        // A word that these turns alone know may have been taken for a slip.
        if !forms::is_same(&spelt, heard) {
            told.extend(ways(&Reader { lexemes: heard, ..reader }));
        }
        told
    }
}

impl Ear<'_> {
    /// The sentence as people talk, in any of the other ways.
    fn talked(&self, heard: &[Lexeme], mut read: Result<Reading, EditError>) -> Result<Reading, EditError> {
        let Self { words, stock, focus, .. } = *self;
        let names = self.names(heard);
        let spelt = slips::corrected(words, heard, &names, stock, &focus.streets);
        let ways = talked::ways(words, heard, &spelt, &names);
        let plainest = ways.last().cloned();
        read = self.first_granted(ways, read);
        let Some(plainest) = plainest else { return read };
        for stage in [Self::in_other_words, Self::placed, Self::told_anew] {
            if self.is_granted(&read) {
                return read;
            }
            read = stage(self, &plainest, read);
        }
        read
    }

    /// "The windmill looks shabby, paint it white": that there is no windmill, where nothing is there that "it" could stand for.
    fn with_what_is_named(
        &self,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        let named = remarked::with_what_is_named(heard);
        if named.len() == heard.len() || !self.stands_for_nothing(&read) {
            return read;
        }
        let anew = self.read(named);
        let is_missing = match &anew {
            Ok(reading) => self.is_missing(reading),
            Err(refused) => matches!(refused, EditError::NotFound { .. }),
        };
        if is_missing { anew } else { read }
    }

    /// Whether a sentence is refused because nothing is there that its pronoun could stand for.
    fn stands_for_nothing(&self, read: &Result<Reading, EditError>) -> bool {
        let Self { scene, stock, focus, .. } = *self;
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        let is_open = |refused: &EditError| matches!(refused, EditError::NotFound { wanted, .. } if wanted.contains("could stand for"));
        match read {
            Ok(reading) => reading.wishes.first().is_some_and(|readings| {
                readings.iter().all(|wish| finder.edits(wish).is_err_and(|refused| is_open(&refused)))
            }),
            Err(refused) => is_open(refused),
        }
    }
}

/// Puts the words of a sentence plainly, one thing at a time, before it is read.
fn put_plainly(
    words: &str,
    lexemes: &mut Vec<Lexeme>,
    names: &Names<'_>,
    (stock, streets): (&Stock, &StreetNames),
) {
    precautions::leave_out(lexemes);
    sky_stated::in_plain_words(lexemes);
    talked::in_plain_words(lexemes);
    beforehand::leave_out(words, lexemes, names);
    unusual_first::in_plain_words(words, lexemes);
    headings::in_plain_words(words, lexemes, names);
    presence::in_plain_words(lexemes);
    meant::in_plain_words(lexemes);
    withdrawn::in_plain_words(lexemes);
    but_me::in_plain_words(lexemes);
    facing::in_plain_words(lexemes);
    margins::in_plain_words(lexemes);
    remarked::in_plain_words(lexemes);
    hesitations::in_plain_words(words, lexemes);
    breaks::in_plain_words(words, lexemes);
    wording::in_plain_words(words, lexemes);
    respelt::in_plain_spelling(words, lexemes);
    homophones::in_plain_spelling(words, lexemes);
    periphrases::in_plain_words(lexemes);
    talk::in_plain_words(words, lexemes, names);
    doubted::in_plain_words(lexemes);
    casual::in_plain_words(lexemes);
    retold::in_plain_words(lexemes);
    doings::in_plain_words(lexemes);
    slips::correct(words, lexemes, names, stock, streets);
    spared::in_plain_words(lexemes);
    sells_both::in_plain_words(lexemes, names);
    phrased::in_plain_words(words, lexemes, names);
    narrowed::in_plain_words(lexemes);
    plain::in_plain_words(words, lexemes, names);
    others::in_plain_words(lexemes);
    which::in_plain_words(lexemes);
    whole::in_plain_words(lexemes);
    passing::leave_out(lexemes);
    rows::on_both_sides(lexemes, streets);
    repairs::put_right(lexemes);
    spoken::name_streets(lexemes, streets);
}
