//! The ways in which a sentence is heard anew that is refused as it stands, one after the other, until what it asks for is granted.

use super::super::lexer::Lexeme;
use super::super::names::Names;
use super::heard::Ear;
use super::memo::Memo;
use super::parse::Reader;
use super::resolve::Finder;
use super::{
    Focus, Reading, anew, forms, kin, lastly, placed, remarked, slips, statements, talked, unusual, view_of,
};
use crate::editing::{EditError, Stock};

/// A way to hear a sentence anew, from its words and what was read so far.
type Stage<'a> = fn(&Ear<'a>, &[Lexeme], Result<Reading, EditError>) -> Result<Reading, EditError>;

/// The ways in their order.
pub(super) fn stages<'a>() -> [Stage<'a>; 9] {
    [
        Ear::across_sentences,
        Ear::in_other_words,
        Ear::placed,
        Ear::told_anew,
        Ear::told_unusually,
        Ear::without_statements,
        Ear::talked,
        Ear::by_their_kin,
        Ear::with_what_is_named,
    ]
}

/// Ways to say what was heard in plainer words.
type Ways = fn(&str, &[Lexeme], &Names<'_>, &Stock, &Focus) -> Vec<Vec<Lexeme>>;

impl Ear<'_> {
    /// The first of the ways of a module that is granted; or else what is wrong with the sentence.
    fn by(
        &self,
        ways: Ways,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        let names = self.names(heard);
        self.first_granted(ways(self.words, heard, &names, self.stock, self.focus), read)
    }

    /// The sentence as it may have been meant, if that is granted; or else what is wrong with it.
    fn in_other_words(
        &self,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        self.by(lastly::ways, heard, read)
    }

    /// As [`Self::in_other_words`], by questions in other words and by scenes that are set.
    fn told_anew(&self, heard: &[Lexeme], read: Result<Reading, EditError>) -> Result<Reading, EditError> {
        self.by(anew::ways, heard, read)
    }

    /// As [`Self::in_other_words`], by turns that few use, conditions on doors, and what is said again by a part of it.
    fn told_unusually(
        &self,
        heard: &[Lexeme],
        read: Result<Reading, EditError>,
    ) -> Result<Reading, EditError> {
        self.by(unusual::ways, heard, read)
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
    pub(super) fn taken_up(&self, heard: &[Lexeme]) -> Option<Result<Reading, EditError>> {
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

    /// As [`Self::in_other_words`], by turns of phrase like those that are known, and by who is told of.
    fn by_their_kin(&self, heard: &[Lexeme], read: Result<Reading, EditError>) -> Result<Reading, EditError> {
        self.by(kin::ways, heard, read)
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
