//! Carrying out actions and commands: which line of the table calls what.

use super::{Action, Command, Intent, Notice, Outcome, Request, Session, SessionCommand, info};
use crate::record::{Of, RunCommand, RunState};
use crate::scene::Side;

/// How many Δt the five-step commands take.
const MANY_STEPS: u32 = 5;

impl Session {
    /// Carries out what a panel sent.
    pub fn perform(&mut self, action: Action) -> Outcome {
        let outcome = self.carry_out(action);
        if let Outcome::Refused(reason) = &outcome {
            self.talk.notices.push(Notice::warning(reason.clone()));
        }
        outcome
    }

    fn carry_out(&mut self, action: Action) -> Outcome {
        match action {
            Action::Command(command) => return self.execute(command),
            Action::Edit { edit, gesture } => return self.edit(&edit, gesture),
            Action::ReplaceText(text) => return self.replace_text(&text),
            Action::KeepDraft(text) => self.keep_draft(text),
            Action::EndGesture => self.settle(),
            Action::AbandonGesture => self.abandon_gesture(),
            Action::Select(keys) => self.selection.set(&keys),
            Action::AddToSelection(keys) => self.selection.add(&keys),
            Action::ToggleSelected(key) => self.selection.toggle(key),
            Action::SelectPlace(place) => self.selection.set_place(place),
            Action::ShowEvent(event) => self.run.shown_event = event,
            Action::GoToEvent(seq) => self.go_to_event(seq),
            Action::Seek(time) => return self.seek(time),
            Action::RunUntil(goal) => self.run_until(goal),
            Action::SetRange(range) => return self.set_range(range),
            Action::GoToBookmark(index) => self.go_to_bookmark(index),
            Action::RenameBookmark(index, name) => self.rename_bookmark(index, &name),
            Action::RemoveBookmark(index) => self.remove_bookmark(index),
            Action::ShareMotion(wanted) => drop(self.run.send(RunCommand::ShareMotion(wanted))),
            Action::SetMemory(mib) => return self.set_memory(mib),
            Action::SetDt(text) => return self.set_dt(&text),
            Action::SetSpeed(speed) => self.set_speed(speed),
            Action::SetMethod(method) => self.set_method(method),
            Action::StopVerification => self.stop_verification(),
            Action::OpenPath(path) => self.ask_then(Intent::OpenPath(path)),
            Action::SaveTo(path) => self.save_to(path),
            Action::SaveRecording(path) => self.save_recording(path),
            Action::WriteExport(path, file) => return self.write_export(&path, &file),
            Action::DialogCancelled => self.talk.after_save = None,
            Action::Answer(answer) => return self.answer(answer),
            Action::Paste(text) => return self.paste(&text, false),
            Action::PasteInPlace(text) => return self.paste(&text, true),
            Action::UseTool(index) => return self.use_tool(index),
            Action::Apply(plan) => return self.apply_plan(plan),
            Action::Repair(repair) => return self.repair(repair),
            Action::RepairAll => return self.repair_all(),
            Action::LookAtDisk => self.look_at_disk(),
        }
        Outcome::Done
    }

    /// Why a command cannot be carried out now, by its row of the table.
    pub fn refusal(&self, command: Command) -> Option<String> {
        let reason = (info(command)?.enabled)(self).err()?;
        Some(format!("Not possible: {reason}"))
    }

    /// Carries out a command; one that its row of the table disables is refused with the row's reason.
    pub fn execute(&mut self, command: SessionCommand) -> Outcome {
        if let Some(reason) = self.refusal(command.into()) {
            return Outcome::Refused(reason);
        }
        match command {
            SessionCommand::New(style) => self.ask_then(Intent::New(style)),
            SessionCommand::Open | SessionCommand::Import => self.talk.requests.push(Request::ChooseOpenPath),
            SessionCommand::OpenSample(index) => self.ask_then(Intent::OpenSample(index)),
            SessionCommand::OpenRecent(index) => return self.open_recent(index),
            SessionCommand::Save => self.save(None),
            SessionCommand::SaveAs => self.save_as(None),
            SessionCommand::SaveRecording => self.ask_for_recording_path(),
            SessionCommand::Reload => self.ask_then(Intent::Reload),
            SessionCommand::Quit => self.ask_then(Intent::Quit),

            SessionCommand::Undo => self.undo(),
            SessionCommand::Redo => self.redo(),
            SessionCommand::Cut => return self.cut(),
            SessionCommand::Copy => return self.copy(),
            SessionCommand::Paste | SessionCommand::PasteInPlace => {
                self.talk.paste_in_place = command == SessionCommand::PasteInPlace;
                self.talk.requests.push(Request::ReadClipboard);
            }
            SessionCommand::Duplicate => return self.duplicate(),
            SessionCommand::Delete => return self.delete(),
            SessionCommand::SelectAll => self.select_all(),
            SessionCommand::SelectNone => self.selection.clear(),
            SessionCommand::Group => return self.group(),
            SessionCommand::Ungroup => return self.ungroup(),
            SessionCommand::MoveUp => return self.shift(Side::Before),
            SessionCommand::MoveDown => return self.shift(Side::After),
            SessionCommand::Hide => return self.hide_selection(),
            SessionCommand::ShowAll => return self.show_all(),
            SessionCommand::Lock => return self.lock_selection(),
            SessionCommand::UnlockAll => return self.unlock_all(),
            SessionCommand::MakeIdsUnique => return self.edit(&crate::scene::Edit::MakeIdsUnique, None),
            SessionCommand::TakeStateAsStart => return self.take_state_as_start(),
            SessionCommand::Add(what) => return self.add(what),

            SessionCommand::Reset => self.reset(),
            SessionCommand::PlayPause if self.is_busy() => self.run.pause(),
            SessionCommand::PlayPause => self.play_forward(),
            SessionCommand::StepForward => self.step(1),
            SessionCommand::StepForwardFive => self.step(MANY_STEPS),
            SessionCommand::StepBack => self.go_back(RunCommand::StepBack),
            SessionCommand::StepBackFive => {
                (0..MANY_STEPS).for_each(|_| self.go_back(RunCommand::StepBack));
            }
            SessionCommand::NextEvent => self.next_event(Of::All),
            SessionCommand::EventBack => self.go_back(RunCommand::EventBack { of: Of::All }),
            SessionCommand::FinishStep => self.go_on(RunCommand::FinishStep),
            SessionCommand::Faster => self.set_speed(self.run.playback.speed() * 2.0),
            SessionCommand::Slower => self.set_speed(self.run.playback.speed() / 2.0),
            SessionCommand::Travel(command) => return self.travel_by(command),
        }
        Outcome::Done
    }

    /// Whether the simulation plays or works on a command.
    pub fn is_busy(&self) -> bool {
        matches!(self.run.frame.state, RunState::Playing | RunState::Busy)
    }

    /// Lets a change of Δt or speed take hold while playing.
    fn play_on(&mut self) {
        self.run.play_on(self.way());
    }

    fn step(&mut self, count: u32) {
        self.go_on(RunCommand::Step { dt: self.run.playback.dt(), count });
    }

    fn set_dt(&mut self, text: &str) -> Outcome {
        if let Err(reason) = self.run.playback.set_dt(text) {
            return Outcome::Refused(reason);
        }
        self.kept.settings.dt = Some(self.run.playback.dt_text().to_owned());
        self.store_settings();
        self.play_on();
        Outcome::Done
    }

    fn set_memory(&mut self, mib: Option<f64>) -> Outcome {
        match self.kept.settings.set_recording_mib(mib) {
            Ok(bytes) => {
                self.store_settings();
                self.run.set_memory(bytes);
                Outcome::Done
            }
            Err(reason) => Outcome::Refused(reason),
        }
    }

    fn set_speed(&mut self, speed: f64) {
        self.run.playback.set_speed(speed);
        self.play_on();
    }

    pub(super) fn can_run(&self) -> Result<(), &'static str> {
        self.can_reset()?;
        if self.run.frame.state == RunState::Faulted {
            return Err("the simulation stopped on a fault; reset it or step back");
        }
        Ok(())
    }

    pub(super) fn can_reset(&self) -> Result<(), &'static str> {
        if self.run.has_no_simulation() { Err("the scene has errors, see Problems") } else { Ok(()) }
    }

    pub(super) fn can_step_back(&self) -> Result<(), &'static str> {
        if self.run.frame.can_step_back { Ok(()) } else { Err("there is nothing recorded to go back to") }
    }

    pub(super) fn can_finish_step(&self) -> Result<(), &'static str> {
        self.can_run()?;
        if self.run.frame.open_step.is_some() { Ok(()) } else { Err("no Δt is open; Next event opens one") }
    }

    /// Shows a recorded event: goes to it, and selects whom it is about.
    pub(super) fn go_to_event(&mut self, seq: u64) {
        let Some(row) = self.run.frame.event(seq).cloned() else { return };
        self.go_back(RunCommand::GoTo { event: seq });
        let keys: Vec<_> = [Some(row.a_key), row.b_key].into_iter().flatten().collect();
        self.selection.set(&keys);
        self.run.shown_event = Some(row);
    }
}
