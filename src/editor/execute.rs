//! Carrying out actions and commands: which line of the table calls what.

use super::{Action, Command, Intent, Notice, Outcome, Request, Session, info};
use crate::record::{RunCommand, RunState};

/// How many Δt the five-step commands take.
const MANY_STEPS: u32 = 5;

impl Session {
    /// Carries out what a panel sent.
    pub fn perform(&mut self, action: Action) -> Outcome {
        let outcome = self.carry_out(action);
        if let Outcome::Refused(reason) = &outcome {
            self.notices.push(Notice::warning(reason.clone()));
        }
        outcome
    }

    fn carry_out(&mut self, action: Action) -> Outcome {
        match action {
            Action::Command(command) => return self.execute(command),
            Action::Edit { edit, gesture } => return self.edit(&edit, gesture),
            Action::EndGesture => self.settle(),
            Action::AbandonGesture => self.abandon_gesture(),
            Action::Select(keys) => self.selection.set(&keys),
            Action::AddToSelection(keys) => self.selection.add(&keys),
            Action::ToggleSelected(key) => self.selection.toggle(key),
            Action::SelectPlace(place) => self.selection.set_place(place),
            Action::ShowEvent(event) => self.shown_event = event,
            Action::GoToEvent(seq) => self.go_to_event(seq),
            Action::SetDt(text) => return self.set_dt(&text),
            Action::SetSpeed(speed) => self.set_speed(speed),
            Action::SetMethod(method) => self.set_method(method),
            Action::OpenPath(path) => self.ask_then(Intent::OpenPath(path)),
            Action::SaveTo(path) => self.save_to(path),
            Action::DialogCancelled => self.after_save = None,
            Action::Answer(answer) => self.answer(answer),
            Action::Paste(text) => return self.paste(&text, false),
            Action::PasteInPlace(text) => return self.paste(&text, true),
            Action::UseTool(index) => return self.use_tool(index),
            Action::Apply(plan) => return self.apply_plan(plan),
            Action::Mend(mend) => return self.mend(mend),
            Action::MendAll => return self.mend_all(),
            Action::LookAtDisk => self.look_at_disk(),
        }
        Outcome::Done
    }

    /// Carries out a command; one that its row of the table disables is refused with the row's reason.
    pub fn execute(&mut self, command: Command) -> Outcome {
        if let Some(Err(reason)) = info(command).map(|row| (row.enabled)(self)) {
            return Outcome::Refused(format!("Not possible: {reason}"));
        }
        match command {
            Command::New(style) => self.ask_then(Intent::New(style)),
            Command::Open => self.requests.push(Request::ChooseOpenPath),
            Command::OpenSample(index) => self.ask_then(Intent::OpenSample(index)),
            Command::OpenRecent(index) => return self.open_recent(index),
            Command::Save => self.save(None),
            Command::SaveAs => self.save_as(None),
            Command::Reload => self.ask_then(Intent::Reload),
            Command::Quit => self.ask_then(Intent::Quit),

            Command::Undo => self.undo(),
            Command::Redo => self.redo(),
            Command::Cut => return self.cut(),
            Command::Copy => return self.copy(),
            Command::Paste | Command::PasteInPlace => {
                self.paste_in_place = command == Command::PasteInPlace;
                self.requests.push(Request::ReadClipboard);
            }
            Command::Duplicate => return self.duplicate(),
            Command::Delete => return self.delete(),
            Command::SelectAll => self.select_all(),
            Command::SelectNone => self.selection.clear(),
            Command::Group => return self.group(),
            Command::Ungroup => return self.ungroup(),
            Command::Hide => return self.hide_selection(),
            Command::ShowAll => return self.show_all(),
            Command::Lock => return self.lock_selection(),
            Command::UnlockAll => return self.unlock_all(),
            Command::MakeIdsUnique => return self.edit(&crate::scene::Edit::MakeIdsUnique, None),
            Command::TakeStateAsStart => return self.take_state_as_start(),

            Command::AddSphereDynamic
            | Command::AddSphereStatic
            | Command::AddPlane
            | Command::AddGravityPlane
            | Command::AddGravityPoint
            | Command::AddDrag => return self.add(command),

            _ => return self.drive(command),
        }
        Outcome::Done
    }

    /// The commands of the transport; all others are the window's.
    fn drive(&mut self, command: Command) -> Outcome {
        match command {
            Command::Reset => self.reset(),
            Command::PlayPause if self.is_busy() => self.pause(),
            Command::PlayPause => self.play(),
            Command::StepForward => self.step(1),
            Command::StepForwardFive => self.step(MANY_STEPS),
            Command::StepBack => self.go_back(RunCommand::StepBack),
            Command::StepBackFive => (0..MANY_STEPS).for_each(|_| self.go_back(RunCommand::StepBack)),
            Command::NextEvent => self.go_on(RunCommand::NextEvent { dt: self.playback.dt() }),
            Command::EventBack => self.go_back(RunCommand::EventBack),
            Command::FinishStep => self.go_on(RunCommand::FinishStep),
            Command::Faster => self.set_speed(self.playback.speed() * 2.0),
            Command::Slower => self.set_speed(self.playback.speed() / 2.0),
            _ => return Outcome::NotMine,
        }
        Outcome::Done
    }

    /// Whether the simulation plays or works on a command.
    pub fn is_busy(&self) -> bool {
        matches!(self.frame.state, RunState::Playing | RunState::Busy)
    }

    fn play(&mut self) {
        let time_speed = self.scene().map_or(1.0, |scene| scene.time_speed);
        let speed = self.playback.speed() * time_speed;
        self.go_on(RunCommand::Play { dt: self.playback.dt(), speed });
    }

    /// Lets a change of Δt or speed take hold while playing.
    pub(super) fn play_on(&mut self) {
        if self.frame.state == RunState::Playing {
            self.play();
        }
    }

    fn step(&mut self, count: u32) {
        self.go_on(RunCommand::Step { dt: self.playback.dt(), count });
    }

    fn set_dt(&mut self, text: &str) -> Outcome {
        if let Err(reason) = self.playback.set_dt(text) {
            return Outcome::Refused(reason);
        }
        self.settings.dt = Some(self.playback.dt_text().to_owned());
        self.store_settings();
        self.play_on();
        Outcome::Done
    }

    fn set_speed(&mut self, speed: f64) {
        self.playback.set_speed(speed);
        self.play_on();
    }

    pub(super) fn can_run(&self) -> Result<(), &'static str> {
        self.can_reset()?;
        if self.frame.state == RunState::Faulted {
            return Err("the simulation stopped on a fault; reset it or step back");
        }
        Ok(())
    }

    pub(super) fn can_reset(&self) -> Result<(), &'static str> {
        if self.has_no_simulation() { Err("the scene has errors, see Problems") } else { Ok(()) }
    }

    pub(super) fn can_step_back(&self) -> Result<(), &'static str> {
        if self.frame.can_step_back { Ok(()) } else { Err("there is nothing recorded to go back to") }
    }

    pub(super) fn can_finish_step(&self) -> Result<(), &'static str> {
        self.can_run()?;
        if self.frame.open_step.is_some() { Ok(()) } else { Err("no Δt is open; Next event opens one") }
    }

    /// Shows an event that is listed, or goes back to it.
    fn go_to_event(&mut self, seq: u64) {
        if self.frame.event(seq).is_none() {
            self.go_back(RunCommand::GoTo { event: seq });
        }
        self.awaited_event = Some(seq);
        self.show_awaited_event();
    }

    pub(super) fn show_awaited_event(&mut self) {
        let Some(seq) = self.awaited_event else { return };
        let Some(row) = self.frame.event(seq).cloned() else { return };
        let keys: Vec<_> = [Some(row.a_key), row.b_key].into_iter().flatten().collect();
        self.selection.set(&keys);
        self.shown_event = Some(row);
        self.awaited_event = None;
    }
}
