//! What things are called by their own names, what places sell, and what to make of a misspelt name.
//!
//! Names are found by the words in them: in the index that the scene keeps or, if it keeps none, in one made by looking
//! at everything. Whoever is out of range has no name.

use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::sync::LazyLock;

use simworld_core::asset::Catalogue;
use simworld_core::geometry::{Aabb, Point2};
use simworld_core::id::EntityId;
use simworld_core::scene::{NameIndex, Scene};

use super::lexer::{Lexeme, Token, tokens};
use super::lexicon::{CATEGORIES, Category, is_plural};
use super::spelling::{Letters, is_anagram};

/// The names within range.
pub(super) struct Names<'a> {
    pub(super) scene: &'a dyn Scene,
    region: Aabb,
    /// Of a scene that keeps no index.
    own: OnceCell<NameIndex>,
    /// What is sold within range, in alphabetical order.
    sold: OnceCell<Vec<Goods>>,
    /// What was made of phrases so far: readings that are tried in turn ask for the same ones.
    guesses: RefCell<Vec<(String, (Guess, usize))>>,
    /// What the sentence may make and speak of later: assets by name, of that catalogue.
    pub(super) made: Option<(&'a Catalogue, Vec<String>)>,
}

struct Goods {
    label: String,
    tokens: Vec<Token>,
}

struct Name {
    id: EntityId,
    label: String,
    tokens: Vec<Token>,
}

/// What a phrase that fits nothing exactly may have meant.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Guess {
    /// One thing only: a name, or part of one, that nothing else bears.
    Named(Vec<EntityId>),
    /// A class, and its word that was meant.
    Category(&'static Category, &'static str),
    /// Several things equally well; what they are called.
    Ambiguous(Vec<String>),
    /// Nothing that is safe to assume; what sounds most alike, if anything does.
    Nothing(Option<String>),
}

impl<'a> Names<'a> {
    /// The names of everything within `range` m of a point.
    pub(super) fn new(scene: &'a dyn Scene, around: Point2, range: f64) -> Self {
        let region = Aabb::column_around(around, range);
        let guesses = RefCell::default();
        Self { scene, region, own: OnceCell::new(), sold: OnceCell::new(), guesses, made: None }
    }

    fn index(&self) -> &NameIndex {
        if let Some(index) = self.scene.names() {
            return index;
        }
        self.own.get_or_init(|| {
            let mut index = NameIndex::default();
            let _ = self.scene.visit(&self.region, &mut |entity| {
                index.insert(entity.id, entity.info);
                ControlFlow::Continue(())
            });
            index
        })
    }

    fn is_in_range(&self, id: EntityId) -> bool {
        self.scene.entity(id).is_some_and(|entity| entity.bounds.intersects(&self.region))
    }

    /// The name of an entity within range.
    fn name(&self, id: EntityId) -> Option<Name> {
        let entity = self.scene.entity(id).filter(|entity| entity.bounds.intersects(&self.region))?;
        let label = entity.info.name.as_ref()?;
        let tokens = name_tokens(label);
        (!tokens.is_empty()).then(|| Name { id, label: label.clone(), tokens })
    }

    /// Those within range in whose name the token stands, ascending.
    fn bearers(&self, token: &Token) -> impl Iterator<Item = Name> {
        self.ids_of(token).filter_map(|id| self.name(id))
    }

    /// What the entity is called, wherever it is.
    fn label(&self, id: EntityId) -> Option<&str> {
        self.scene.entity(id)?.info.name.as_deref()
    }

    /// Those in whose name the token stands, wherever they are.
    fn ids_of(&self, token: &Token) -> impl Iterator<Item = EntityId> {
        let (words, numbers) = match token {
            Token::Word(word) => (Some(self.index().bearers(word)), None),
            Token::Number(_) => (None, Some(self.index().numbered())),
            _ => (None, None),
        };
        words.into_iter().flatten().chain(numbers.into_iter().flatten())
    }

    fn sold_here(&self) -> &[Goods] {
        self.sold.get_or_init(|| {
            let here =
                self.index().goods().filter(|(_, sellers)| sellers.clone().any(|id| self.is_in_range(id)));
            let goods = here.map(|(goods, _)| Goods { label: goods.to_owned(), tokens: name_tokens(goods) });
            goods.filter(|goods| !goods.tokens.is_empty()).collect()
        })
    }

    fn words_sold(&self) -> impl Iterator<Item = &str> {
        self.sold_here().iter().flat_map(|goods| &goods.tokens).filter_map(|token| match token {
            Token::Word(word) => Some(word.as_str()),
            _ => None,
        })
    }

    /// Whether it is a word of a name or of what is sold.
    pub(super) fn has_word(&self, word: &str) -> bool {
        self.index().bearers(word).any(|id| self.is_in_range(id))
            || self.words_sold().any(|sold| sold == word)
    }

    /// The words of names, near and far, and of what is sold that begin so.
    pub(super) fn words_from<'b>(&'b self, beginning: &'b str) -> impl Iterator<Item = &'b str> {
        let named = self.index().words_from(beginning);
        named.chain(self.words_sold().filter(move |word| word.starts_with(beginning)))
    }

    /// What is sold somewhere and named at the start of the phrase, in the singular or the plural.
    pub(super) fn goods(&self, lexemes: &[Lexeme]) -> Option<(String, usize)> {
        let fits = |tokens: &[Token]| {
            let said = lexemes.get(..tokens.len())?;
            let same = said.iter().zip(tokens).all(|(lexeme, token)| match (&lexeme.token, token) {
                (Token::Word(said), Token::Word(word)) => said == word || is_plural(said, word),
                (said, token) => said == token,
            });
            same.then_some(tokens.len())
        };
        let hits = self.sold_here().iter().filter_map(|goods| Some((fits(&goods.tokens)?, &goods.label)));
        hits.max_by_key(|(count, _)| *count).map(|(count, goods)| (goods.clone(), count))
    }

    /// Those within range who sell it, ascending.
    pub(super) fn sellers(&self, goods: &str) -> Vec<EntityId> {
        let sellers = self
            .index()
            .goods()
            .find(|(sold, _)| *sold == goods)
            .into_iter()
            .flat_map(|(_, sellers)| sellers);
        sellers.filter(|id| self.is_in_range(*id)).collect()
    }

    /// What is sold here, for answers.
    pub(super) fn sold(&self) -> String {
        let goods: Vec<&str> = self.sold_here().iter().map(|goods| goods.label.as_str()).collect();
        if goods.is_empty() {
            "nothing is sold here".to_owned()
        } else {
            format!("sold are {}", goods.join(", "))
        }
    }

    /// The entities whose name begins the phrase; of several names the longest. With the number of tokens it takes.
    pub(super) fn exact(&self, lexemes: &[Lexeme]) -> Option<(Vec<EntityId>, usize)> {
        let mut hits: Vec<(EntityId, usize)> = Vec::new();
        let first = &lexemes.first()?.token;
        for id in self.ids_of(first) {
            // Most of those with the word in their names have it behind others: "house".
            if self.label(id).is_some_and(|label| may_begin(label, first))
                && let Some(name) = self.name(id)
            {
                hits.extend(begins_with(lexemes, &name.tokens).map(|count| (id, count)));
            }
        }
        let longest = hits.iter().map(|(_, count)| *count).max()?;
        let ids = hits.iter().filter(|(_, count)| *count == longest).map(|(id, _)| *id).collect();
        Some((ids, longest))
    }

    /// What a phrase means that is part of a name.
    pub(super) fn part(&self, phrase: &[Lexeme]) -> Option<Guess> {
        let said: Vec<&Token> = phrase.iter().map(|lexeme| &lexeme.token).collect();
        let bearers = |token: &&&Token| match token {
            Token::Word(word) => self.index().count(word),
            _ => usize::MAX, // other words say more
        };
        let rarest = said.iter().min_by_key(bearers)?;
        let part_of = |name: &Name| name.tokens.windows(said.len()).any(|part| part.iter().eq(said.clone()));
        let parts: Vec<Name> = self.bearers(rarest).filter(part_of).collect();
        (!parts.is_empty()).then(|| one_name(&parts.iter().collect::<Vec<_>>()))
    }

    /// Several whose names end in the word, said in the singular or the plural: stalls are what is called "Bread Stall" and "Fish Stall".
    pub(super) fn sort(&self, said: &Token) -> Option<Vec<EntityId>> {
        let Token::Word(said) = said else { return None };
        let singular = said.strip_suffix('s').filter(|word| word.len() > 2);
        let of = |word: &str| {
            let word = Token::Word(word.to_owned());
            // "All the tents", where each is called "tent".
            let plural = word != Token::Word(said.clone());
            let names = self.bearers(&word).filter(|name| name.tokens.len() > 1 || plural);
            names.filter(|name| name.tokens.last() == Some(&word)).map(|name| name.id).collect::<Vec<_>>()
        };
        let sort = std::iter::once(said.as_str()).chain(singular).map(of);
        sort.into_iter().find(|ids| ids.len() > 1)
    }

    /// Those that sell something and have the word in their names, in the singular or the plural, ascending.
    pub(super) fn shops_called(&self, said: &Token) -> Vec<EntityId> {
        let Token::Word(said) = said else { return Vec::new() };
        let sells = |id: &EntityId| {
            self.scene
                .entity(*id)
                .is_some_and(|entity| entity.info.attributes.contains_key(simworld_core::scene::SELLS))
        };
        let of = |word: String| {
            let word = Token::Word(word);
            let named = self.bearers(&word).map(|name| name.id).filter(sells);
            named.collect::<Vec<_>>()
        };
        let found = [said.clone(), format!("{said}s")].into_iter().map(of);
        found.into_iter().find(|ids| !ids.is_empty()).unwrap_or_default()
    }

    /// What a phrase that is no exact name may have meant, with how many of its words are said by that: all, or the
    /// longest beginning that is part of a name ("the library door").
    pub(super) fn guess_or_part(&self, phrase: &[Lexeme]) -> (Guess, usize) {
        let said = join(phrase.iter().map(|lexeme| &lexeme.token));
        if let Some((_, guess)) = self.guesses.borrow().iter().find(|(known, _)| *known == said) {
            return guess.clone();
        }
        let guess = match self.guess(phrase) {
            nothing @ Guess::Nothing(_) => (1..phrase.len())
                .rev()
                .find_map(|count| self.part(&phrase[..count]).map(|guess| (guess, count)))
                .unwrap_or((nothing, phrase.len())),
            guess => (guess, phrase.len()),
        };
        self.guesses.borrow_mut().push((said, guess.clone()));
        guess
    }

    /// What a whole phrase that is no exact name may have meant.
    fn guess(&self, phrase: &[Lexeme]) -> Guess {
        if let Some(part) = self.part(phrase) {
            return part;
        }
        let said = join(phrase.iter().map(|lexeme| &lexeme.token));
        let length = said.chars().count();
        let similar = (length / 3).max(1);
        let (mut least, letters) = (similar.max(tolerance(&said)), Letters::of(&said));
        let names = self.alike(phrase);
        let mut found: Vec<Candidate<'_>> = Vec::new();
        for (candidate, spelling) in candidates(&names) {
            let edits = spelling.letters.least_edits(letters).max(spelling.length.abs_diff(length));
            if edits > least {
                continue;
            }
            let distance = strsim::osa_distance(&said, &spelling.text);
            if distance < least {
                found.clear();
                least = distance;
            }
            if distance == least {
                found.push(candidate);
            }
        }
        // Two letters of somebody's name in each other's place: "Delai".
        let swapped = match found[..] {
            [Candidate::Name(name)] if least == 1 && length > 3 => {
                is_anagram(&said, &join(name.tokens.iter()))
            }
            _ => false,
        };
        if found.is_empty() || least > tolerance(&said) && !swapped {
            return Guess::Nothing(found.first().filter(|_| least <= similar).map(Candidate::label));
        }
        agreed(&found)
    }

    /// The names with a word of the phrase, or with one that begins as the phrase does.
    fn alike(&self, phrase: &[Lexeme]) -> Vec<Name> {
        let words = phrase.iter().filter_map(|lexeme| match &lexeme.token {
            Token::Word(word) => Some(word.as_str()),
            _ => None,
        });
        let index = self.index();
        let mut ids: BTreeSet<EntityId> = words.clone().flat_map(|word| index.bearers(word)).collect();
        if let Some(first) = words.clone().next().and_then(|word| word.chars().next()) {
            let beginning = first.to_string();
            ids.extend(index.words_from(&beginning).flat_map(|word| index.bearers(word)));
        }
        ids.into_iter().filter_map(|id| self.name(id)).collect()
    }
}

/// All that a phrase may have meant, as it is spelt: these names, and every class.
fn candidates(names: &[Name]) -> impl Iterator<Item = (Candidate<'_>, Cow<'_, Spelling>)> {
    static CLASSES: LazyLock<Vec<(Candidate<'static>, Spelling)>> = LazyLock::new(|| {
        let words = CATEGORIES.iter().flat_map(|class| class.words.iter().map(move |word| (class, *word)));
        words.map(|(class, word)| (Candidate::Class(class, word), Spelling::of(word.to_owned()))).collect()
    });
    let named =
        names.iter().map(|name| (Candidate::Name(name), Cow::Owned(Spelling::of(join(name.tokens.iter())))));
    named.chain(CLASSES.iter().map(|(class, spelling)| (*class, Cow::Borrowed(spelling))))
}

/// How something is spelt, with what tells it from most other spellings.
#[derive(Clone)]
struct Spelling {
    text: String,
    length: usize,
    letters: Letters,
}

impl Spelling {
    fn of(text: String) -> Self {
        Self { length: text.chars().count(), letters: Letters::of(&text), text }
    }
}

/// Something a phrase may have meant.
#[derive(Clone, Copy)]
enum Candidate<'a> {
    Name(&'a Name),
    Class(&'static Category, &'static str),
}

impl Candidate<'_> {
    /// The word of the class.
    fn word(&self) -> &'static str {
        match self {
            Self::Name(_) => "",
            Self::Class(_, word) => word,
        }
    }

    fn label(&self) -> String {
        match self {
            Self::Name(name) => name.label.clone(),
            Self::Class(_, word) => (*word).to_owned(),
        }
    }
}

/// Edits (insertions, deletions, substitutions, swaps of neighbours) that a phrase may be away from what it means.
/// Short words get none: "beach" is no misspelt "bench".
fn tolerance(said: &str) -> usize {
    match said.chars().count() {
        0..=5 => 0,
        6..=9 => 1,
        10..=14 => 2,
        _ => 3,
    }
}

fn agreed(found: &[Candidate<'_>]) -> Guess {
    let names: Vec<&Name> = found
        .iter()
        .filter_map(|found| if let Candidate::Name(name) = found { Some(*name) } else { None })
        .collect();
    match found[0] {
        Candidate::Name(_) if names.len() == found.len() => one_name(&names),
        Candidate::Class(category, _) if found.iter().all(|other| is_class(other, category)) => {
            Guess::Category(category, found[0].word())
        }
        _ => Guess::Ambiguous(found.iter().take(4).map(Candidate::label).collect()),
    }
}

fn is_class(candidate: &Candidate<'_>, category: &Category) -> bool {
    matches!(candidate, Candidate::Class(other, _) if *other == category)
}

/// The bearers, if they all bear the same name.
fn one_name(found: &[&Name]) -> Guess {
    if found.iter().all(|name| name.tokens == found[0].tokens) {
        return Guess::Named(found.iter().map(|name| name.id).collect());
    }
    let mut labels: Vec<String> = found.iter().map(|name| name.label.clone()).collect();
    labels.sort_unstable();
    labels.dedup();
    labels.truncate(4);
    Guess::Ambiguous(labels)
}

/// The tokens of a name without punctuation and without a leading article.
fn name_tokens(name: &str) -> Vec<Token> {
    let mut tokens: Vec<Token> = tokens(name)
        .map(|(token, ..)| token)
        .filter(|token| matches!(token, Token::Word(_) | Token::Number(_)))
        .collect();
    if tokens.len() > 1 && tokens[0] == Token::Word("the".to_owned()) {
        tokens.remove(0);
    }
    tokens
}

/// Whether a name may begin with the token: "no" is certain, and said without taking the name apart.
fn may_begin(name: &str, first: &Token) -> bool {
    let Token::Word(word) = first else { return true };
    let begins = |name: &str| {
        let (Some(letter), Some(said)) = (name.chars().next(), word.chars().next()) else { return true };
        // What other signs stand for is left to the lexer.
        !letter.is_ascii_alphanumeric() || !said.is_ascii() || letter.eq_ignore_ascii_case(&said)
    };
    let article = name.get(..3).is_some_and(|article| article.eq_ignore_ascii_case("the"));
    begins(name) || article && begins(name[3..].trim_start())
}

/// How many lexemes at the start say the name; punctuation between its words does not count.
fn begins_with(lexemes: &[Lexeme], name: &[Token]) -> Option<usize> {
    let mut at = 0;
    for (index, wanted) in name.iter().enumerate() {
        while index > 0 && matches!(lexemes.get(at).map(|l| &l.token), Some(Token::Break | Token::Comma)) {
            at += 1;
        }
        if lexemes.get(at).map(|lexeme| &lexeme.token) != Some(wanted) {
            return None;
        }
        at += 1;
    }
    Some(at)
}

fn join<'a>(tokens: impl Iterator<Item = &'a Token>) -> String {
    let words: Vec<String> = tokens
        .filter_map(|token| match token {
            Token::Word(word) => Some(word.clone()),
            Token::Number(number) => Some(number.to_string()),
            _ => None,
        })
        .collect();
    words.join(" ")
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a helper of tests")]
mod tests {
    use proptest::prelude::*;
    use simworld_core::geometry::Pose;
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::super::lexer::lex;
    use super::*;

    proptest! {
        /// The words of the index are those of the sentences: what is said as it is written is found.
        #[test]
        fn every_name_is_found_by_its_own_words(name in "[A-Za-zÄß0-9 .,'’&#-]{1,24}|\\PC{1,12}") {
            let mut world = World::new();
            let thing = EntityDesc::new(EntityKind::Prop, Pose::identity(), Shape::cuboid(1.0, 1.0, 1.0));
            let id = world.spawn(thing.named(name.clone())).unwrap();
            let names = Names::new(&world, Point2::origin(), 10.0);
            let mut said = lex(&name);
            said.retain(|lexeme| matches!(lexeme.token, Token::Word(_) | Token::Number(_)));
            let article = usize::from(said.len() > 1 && said[0].token == Token::Word("the".to_owned()));
            let said = &said[article..];
            if said.is_empty() {
                return Ok(());
            }
            prop_assert_eq!(names.exact(said), Some((vec![id], said.len())));
            prop_assert_eq!(names.part(&said[said.len() / 2..]), Some(Guess::Named(vec![id])));
        }
    }
}
