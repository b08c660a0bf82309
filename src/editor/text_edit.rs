//! The text of the whole file edited by hand: kept while it is a draft, taken as one undo point if it is a scene.

use std::sync::Arc;

use super::dialogue::{Intent, Question};
use super::text_draft::TextDraft;
use super::{Outcome, Session};
use crate::scene::{Diagnostic, Document};

impl Session {
    /// The text of the file as it is being typed, if it differs from the document.
    pub fn draft(&self) -> Option<&str> {
        self.doc.draft.as_ref().map(TextDraft::text)
    }

    /// Whether closing now would lose something that nobody agreed to lose.
    pub fn has_unsaved_work(&self) -> bool {
        !self.talk.ends && (self.is_dirty() || self.doc.draft.is_some())
    }

    /// Keeps what was typed so far, so that neither a question forgotten nor a crash loses it.
    pub(super) fn keep_draft(&mut self, text: Option<Arc<str>>) {
        self.doc.drafts += 1;
        let revision = self.doc.drafts;
        self.doc.draft = text.map(|text| TextDraft::new(text, revision));
    }

    /// The question that comes before a draft is lost.
    pub(super) fn question_of_draft(&self, then: &Intent) -> Option<Question> {
        // Reading the file again leaves the draft as it is.
        let draft = self.draft().filter(|_| *then != Intent::Reload)?;
        let new = self.document().rewritten(draft);
        let problem = first_error(&new).map(ToString::to_string);
        Some(Question::UnappliedText { title: self.doc.file.title.clone(), problem, then: then.clone() })
    }

    /// Applies the draft and goes on to what would have lost it.
    pub(super) fn apply_draft_then(&mut self, then: Intent) -> Outcome {
        let Some(text) = self.draft().map(ToOwned::to_owned) else { return Outcome::Done };
        let outcome = self.replace_text(&text);
        if outcome == Outcome::Done {
            self.ask_then(then);
        }
        outcome
    }

    /// Takes a text of the file in the place of the document. Bodies and forces that are still there go on as they are;
    /// a text with errors is refused.
    pub(super) fn replace_text(&mut self, text: &str) -> Outcome {
        self.settle();
        let new = self.document().rewritten(text);
        if let Some(problem) = first_error(&new) {
            return Outcome::Refused(format!("The text is not a scene yet: {problem}"));
        }
        self.keep_draft(None);
        if new.to_bytes() == self.document().to_bytes() {
            return Outcome::Done;
        }
        let touched = self.document().differences(&new);
        self.doc.history.push(new, "Edit the text".to_owned(), &touched, None);
        self.document_changed(&touched);
        Outcome::Done
    }
}

fn first_error(document: &Document) -> Option<&Diagnostic> {
    document.diagnostics().iter().find(|problem| problem.is_error())
}
