//! The text of the whole file edited by hand: taken as one undo point, if it is a scene.

use super::{Outcome, Session};
use crate::scene::Diagnostic;

impl Session {
    /// Takes a text of the file in the place of the document. Bodies and forces that are still there go on as they are;
    /// a text with errors is refused.
    pub(super) fn replace_text(&mut self, text: &str) -> Outcome {
        self.settle();
        let new = self.document().rewritten(text);
        if let Some(problem) = new.diagnostics().iter().find(|problem| problem.is_error()) {
            return Outcome::Refused(refusal(problem));
        }
        if new.to_bytes() == self.document().to_bytes() {
            return Outcome::Done;
        }
        let touched = self.document().differences(&new);
        self.doc.history.push(new, "Edit the text".to_owned(), &touched, None);
        self.document_changed(&touched);
        Outcome::Done
    }
}

fn refusal(problem: &Diagnostic) -> String {
    format!("The text is not a scene yet: {problem}")
}
