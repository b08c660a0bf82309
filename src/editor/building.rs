//! Tools that build, arrange, select and repair: plans of [`crate::design`] become one undo step each.

use glam::DVec3;

use super::copies::LastCopies;
use super::edits::locked_keys;
use super::{Notice, Outcome, Session};
use crate::design::{self, Eye, Given, Plan, Repair, Repaired, TOOLS};
use crate::scene::{Edit, Side};

impl Session {
    /// What tools work on, seen from here.
    pub fn given(&self, eye: Eye) -> Option<Given<'_>> {
        Some(Given { scene: self.scene()?, keys: self.selection.keys(), eye })
    }

    /// Why a tool cannot be used now.
    pub fn can_use_tool(&self, index: usize) -> Result<(), &'static str> {
        let tool = TOOLS.get(index).ok_or("there is no such tool")?;
        let given = self.given(Eye::default()).ok_or("the file has errors, see Problems")?;
        (tool.enabled)(&given)
    }

    /// Uses a tool as it is; the window asks for what others need.
    pub(super) fn use_tool(&mut self, index: usize) -> Outcome {
        if let Err(reason) = self.can_use_tool(index) {
            return Outcome::Refused(format!("Not possible: {reason}"));
        }
        let (Some(tool), Some(given)) = (TOOLS.get(index), self.given(Eye::default())) else {
            return Outcome::no_scene();
        };
        match tool.plan(&given, &design::free_place(tool, &given, &tool.defaults(&given))) {
            Ok(plan) => self.apply_plan(plan),
            Err(reason) => Outcome::Refused(reason),
        }
    }

    /// Carries out a plan as one undo step, and tells its remark.
    pub(super) fn apply_plan(&mut self, plan: Plan) -> Outcome {
        let Plan { label, edits, select, remark } = plan;
        if !edits.is_empty() {
            let outcome = self.edit_as(&Edit::All(edits), None, Some(label));
            if outcome != Outcome::Done {
                return outcome;
            }
        }
        if let Some(keys) = select {
            self.selection.set(&keys);
        }
        self.talk.notices.extend(remark.map(Notice::info));
        Outcome::Done
    }

    /// Puts a problem right.
    pub(super) fn repair(&mut self, repair: Repair) -> Outcome {
        let Some(scene) = self.scene() else { return Outcome::no_scene() };
        match design::repair(scene, repair) {
            Some(plan) => self.apply_plan(plan),
            None => Outcome::Refused(format!("{}: there is nothing that could be changed", repair.label())),
        }
    }

    /// Puts right all that can be, as one undo step, and tells what was done.
    pub(super) fn repair_all(&mut self) -> Outcome {
        self.settle();
        let Repaired { document, touched, done } = match design::repair_all(self.document()) {
            Ok(repaired) => repaired,
            Err(reason) => return Outcome::Refused(reason.to_string()),
        };
        if done.is_empty() {
            return Outcome::Refused("There is nothing that could be put right".to_owned());
        }
        self.doc.history.push(document, "Put all right".to_owned(), &touched, None);
        self.document_changed(&touched);
        self.talk.notices.push(Notice::info(format!("This {}", done.join(", "))));
        Outcome::Done
    }

    /// Copies the selection to a free place beside it; repeated, by the same step, also one made by hand.
    pub(super) fn duplicate(&mut self) -> Outcome {
        let Some(scene) = self.scene() else { return Outcome::no_scene() };
        let keys = self.selection.keys().to_vec();
        let step = self.doc.last_copies.as_ref().and_then(|last| last.step(scene, &keys));
        let original = keys.iter().copied().find(|key| scene.bodies.iter().any(|body| body.key == *key));
        let plan = design::duplicate(scene, &keys, step);
        let outcome = self.apply_plan(plan);
        if let (Outcome::Done, Some(original)) = (&outcome, original) {
            let copies = self.selection.keys().to_vec();
            self.doc.last_copies = Some(LastCopies { original, copies });
        }
        outcome
    }

    /// Gathers the selection in a group with a name of its own.
    pub(super) fn group(&mut self) -> Outcome {
        let Some(given) = self.given(Eye::default()) else { return Outcome::no_scene() };
        let plan = design::group(&given);
        self.apply_plan(plan)
    }

    /// Takes the selection out of its groups.
    pub(super) fn ungroup(&mut self) -> Outcome {
        let Some(given) = self.given(Eye::default()) else { return Outcome::no_scene() };
        let plan = design::ungroup(&given);
        self.apply_plan(plan)
    }

    /// Moves the selection up or down in the tree.
    pub(super) fn shift(&mut self, side: Side) -> Outcome {
        let Some(given) = self.given(Eye::default()) else { return Outcome::no_scene() };
        let plan = design::shift(&given, side);
        if plan.edits.is_empty() {
            let end = if side == Side::Before { "first" } else { "last" };
            self.talk.notices.push(Notice::info(format!("It is the {end} of its kind already")));
            return Outcome::Done;
        }
        self.apply_plan(plan)
    }

    /// Moves the selection by whole snap steps; locked items stay.
    pub fn nudge(&self, offset: DVec3) -> Option<Edit> {
        let given = self.given(Eye::default())?;
        let locked = locked_keys(given.scene);
        let edits = design::moved(&given, offset, |key| locked.contains(&key));
        (!edits.is_empty()).then_some(Edit::All(edits))
    }

    pub(super) fn has_group(&self) -> Result<(), &'static str> {
        let any = self.given(Eye::default()).is_some_and(|given| {
            given.bodies().iter().any(|body| body.group.is_some())
                || given.forces().iter().any(|force| force.group.is_some())
        });
        if any { Ok(()) } else { Err("nothing that is selected is in a group") }
    }
}
