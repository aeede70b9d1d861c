//! What was edited, so that it can be taken back and done again.

use simworld_core::command::Command;

/// One sentence that was carried out.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Done {
    /// What was asked.
    pub(super) what: String,
    /// The commands that take it back, in order.
    pub(super) back: Vec<Command>,
}

/// Sentences that can be taken back, and those that were.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct History {
    done: Vec<Done>,
    undone: Vec<Done>,
}

impl History {
    /// Writes down what was done; what was taken back before cannot be done again after it.
    pub(super) fn push(&mut self, what: String, back: Vec<Command>) {
        if !back.is_empty() {
            self.done.push(Done { what, back });
            self.undone.clear();
        }
    }

    pub(super) fn last_done(&mut self) -> Option<Done> {
        self.done.pop()
    }

    pub(super) fn last_undone(&mut self) -> Option<Done> {
        self.undone.pop()
    }

    /// What was taken back, with the commands that do it again.
    pub(super) fn took_back(&mut self, what: String, again: Vec<Command>) {
        self.undone.push(Done { what, back: again });
    }

    /// What was done again, with the commands that take it back.
    pub(super) fn did_again(&mut self, what: String, back: Vec<Command>) {
        self.done.push(Done { what, back });
    }
}
