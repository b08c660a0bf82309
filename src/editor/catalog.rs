//! The one table of commands. It feeds menus, tool bar, shortcuts, palette, help sheet and tests.

use super::Session;
use super::catalog_views::VIEWING;
use super::command::{Addition, Command, Key, Menu, SessionCommand, Shortcut, TravelCommand, WindowCommand};
use super::command_info::{CommandInfo, row};
use crate::scene::NumberStyle;

/// All commands, in the order in which menus list them. Samples, recent files and overlays have tables
/// of their own and reach the menus through [`SessionCommand::OpenSample`] and the like.
pub const COMMANDS: &[CommandInfo] = &joined();

/// The menus of the scene and its run, then those of [`VIEWING`].
const fn joined() -> [CommandInfo; WORKING.len() + VIEWING.len()] {
    let mut all = [WORKING[0]; WORKING.len() + VIEWING.len()];
    let mut at = 0;
    while at < all.len() {
        all[at] = if at < WORKING.len() { WORKING[at] } else { VIEWING[at - WORKING.len()] };
        at += 1;
    }
    all
}

/// File, Edit, Add, Simulation.
const WORKING: &[CommandInfo] = &[
    row(Menu::File, 0, "new", "New", "Starts an empty scene that writes numbers as 9.8")
        .session(SessionCommand::New(NumberStyle::Point))
        .icon('🗋')
        .keys(&[Shortcut::ctrl('N')]),
    row(Menu::File, 0, "new_comma", "New with decimal comma", "Starts an empty scene for the old tools: 9,8")
        .session(SessionCommand::New(NumberStyle::Comma)),
    row(Menu::File, 0, "open", "Open…", "Opens a scene file")
        .session(SessionCommand::Open)
        .icon('📂')
        .keys(&[Shortcut::ctrl('O')]),
    row(Menu::File, 0, "reload", "Reload", "Reads the file again from the disk")
        .session(SessionCommand::Reload)
        .when(Session::can_reload),
    row(Menu::File, 1, "save", "Save", "Writes the scene to its file; what you did not edit keeps its bytes")
        .session(SessionCommand::Save)
        .icon('💾')
        .keys(&[Shortcut::ctrl('S')])
        .when(Session::can_save),
    row(Menu::File, 1, "save_as", "Save as…", "Writes the scene to another file")
        .session(SessionCommand::SaveAs)
        .keys(&[Shortcut::ctrl_shift('S')]),
    row(
        Menu::File,
        2,
        "import",
        "Import…",
        "Opens a scene of MuJoCo or Gazebo as a new one, and says what it loses",
    )
    .session(SessionCommand::Import),
    row(
        Menu::File,
        2,
        "export",
        "Export…",
        "Writes the scene for another program, and says what it cannot be told",
    )
    .window(WindowCommand::Export(None))
    .keys(&[Shortcut::ctrl('E')])
    .when(Session::has_scene),
    row(
        Menu::File,
        2,
        "save_recording",
        "Save recording…",
        "Writes what makes this very run again, to send it on",
    )
    .session(SessionCommand::SaveRecording)
    .when(Session::can_reset),
    row(Menu::File, 3, "settings", "Settings…", "How much memory the recording of a run may take")
        .window(WindowCommand::Settings)
        .keys(&[Shortcut::ctrl(',')]),
    row(Menu::File, 4, "quit", "Quit", "Leaves the application; asks first when something is not saved")
        .session(SessionCommand::Quit)
        .keys(&[Shortcut::ctrl('Q')]),
    //
    row(Menu::Edit, 0, "undo", "Undo", "Takes back the last edit of the scene")
        .session(SessionCommand::Undo)
        .icon('↩')
        .keys(&[Shortcut::ctrl('Z')])
        .when(Session::can_undo),
    row(Menu::Edit, 0, "redo", "Redo", "Repeats the edit that was taken back")
        .session(SessionCommand::Redo)
        .icon('↪')
        .keys(&[Shortcut::ctrl('Y'), Shortcut::ctrl_shift('Z')])
        .when(Session::can_redo),
    row(Menu::Edit, 1, "cut", "Cut", "Copies the selection as XML and deletes it")
        .session(SessionCommand::Cut)
        .keys(&[Shortcut::ctrl('X')])
        .when(Session::has_selection),
    row(Menu::Edit, 1, "copy", "Copy", "Copies the selected bodies and forces as XML")
        .session(SessionCommand::Copy)
        .keys(&[Shortcut::ctrl('C')])
        .when(Session::has_selection),
    row(Menu::Edit, 1, "paste", "Paste", "Adds the bodies and forces of a scene on the clipboard")
        .session(SessionCommand::Paste)
        .keys(&[Shortcut::ctrl('V')])
        .when(Session::has_scene),
    row(
        Menu::Edit,
        1,
        "paste_in_place",
        "Paste in place",
        "Adds what is on the clipboard at the very places it was copied from",
    )
    .session(SessionCommand::PasteInPlace)
    .keys(&[Shortcut::ctrl_shift('V')])
    .when(Session::has_scene),
    row(
        Menu::Edit,
        1,
        "duplicate",
        "Duplicate",
        "Adds a copy of the selection at a free place beside it; repeated, by the same step",
    )
    .session(SessionCommand::Duplicate)
    .icon('⎘')
    .keys(&[Shortcut::ctrl('D')])
    .when(Session::has_selection),
    row(Menu::Edit, 1, "delete", "Delete", "Removes the selected bodies and forces")
        .session(SessionCommand::Delete)
        .icon('🗑')
        .keys(&[Shortcut::plain(Key::Delete)])
        .when(Session::has_selection),
    row(Menu::Edit, 2, "select_all", "Select all", "Selects all visible bodies and forces")
        .session(SessionCommand::SelectAll)
        .keys(&[Shortcut::ctrl('A')])
        .when(Session::has_scene),
    row(Menu::Edit, 2, "select_none", "Select none", "Clears the selection")
        .session(SessionCommand::SelectNone)
        .keys(&[Shortcut::plain(Key::Escape)]),
    row(Menu::Edit, 2, "find", "Find in the scene tree", "Shows only what has the typed letters in its name")
        .window(WindowCommand::Find)
        .keys(&[Shortcut::ctrl('F')])
        .when(Session::has_scene),
    row(Menu::Edit, 3, "rename", "Rename", "Gives a name to what was selected last")
        .window(WindowCommand::Rename)
        .keys(&[Shortcut::plain(Key::Function(2))])
        .when(Session::has_selection),
    row(Menu::Edit, 3, "group", "Group", "Gathers the selection in a group of the scene tree")
        .session(SessionCommand::Group)
        .keys(&[Shortcut::ctrl('G')])
        .when(Session::has_selection),
    row(Menu::Edit, 3, "ungroup", "Ungroup", "Takes the selection out of its group")
        .session(SessionCommand::Ungroup)
        .keys(&[Shortcut::ctrl_shift('G')])
        .when(Session::has_group),
    row(Menu::Edit, 3, "move_up", "Move up", "Moves the selection up in the scene tree and in the file")
        .session(SessionCommand::MoveUp)
        .keys(&[Shortcut::ctrl_key(Key::Up)])
        .when(Session::has_selection),
    row(
        Menu::Edit,
        3,
        "move_down",
        "Move down",
        "Moves the selection down in the scene tree and in the file",
    )
    .session(SessionCommand::MoveDown)
    .keys(&[Shortcut::ctrl_key(Key::Down)])
    .when(Session::has_selection),
    row(
        Menu::Edit,
        3,
        "hide",
        "Hide",
        "Keeps the selection out of the views; it still takes part in the simulation",
    )
    .session(SessionCommand::Hide)
    .keys(&[Shortcut::plain(Key::Char('H'))])
    .when(Session::has_selection),
    row(Menu::Edit, 3, "show_all", "Show all", "Shows everything that was hidden")
        .session(SessionCommand::ShowAll)
        .keys(&[Shortcut::shift(Key::Char('H'))])
        .when(Session::has_hidden),
    row(Menu::Edit, 3, "lock", "Lock", "Protects the selection from being moved or deleted")
        .session(SessionCommand::Lock)
        .when(Session::has_selection),
    row(Menu::Edit, 3, "unlock_all", "Unlock all", "Lets everything be moved and deleted again")
        .session(SessionCommand::UnlockAll)
        .when(Session::has_locked),
    row(
        Menu::Edit,
        4,
        "make_ids_unique",
        "Make IDs unique",
        "Gives a new UserID to everything that repeats one",
    )
    .session(SessionCommand::MakeIdsUnique)
    .when(Session::has_repeated_ids),
    row(
        Menu::Edit,
        4,
        "take_state_as_start",
        "Take current state as start",
        "Writes the positions and velocities of this moment into the scene, which then starts from them",
    )
    .session(SessionCommand::TakeStateAsStart)
    .when(Session::can_take_state),
    //
    row(
        Menu::Add,
        0,
        "add_sphere_dynamic",
        "Dynamic sphere",
        "Adds a sphere that forces and collisions move",
    )
    .session(SessionCommand::Add(Addition::SphereDynamic))
    .icon('●')
    .when(Session::has_scene),
    row(Menu::Add, 0, "add_sphere_static", "Static sphere", "Adds a sphere that never moves")
        .session(SessionCommand::Add(Addition::SphereStatic))
        .icon('○')
        .when(Session::has_scene),
    row(Menu::Add, 0, "add_plane", "Static plane", "Adds a bounded plane that never moves")
        .session(SessionCommand::Add(Addition::Plane))
        .icon('▱')
        .when(Session::has_scene),
    row(
        Menu::Add,
        1,
        "add_gravity_plane",
        "Uniform gravity",
        "Adds the same acceleration for all dynamic bodies",
    )
    .session(SessionCommand::Add(Addition::GravityPlane))
    .icon('⬇')
    .when(Session::has_scene),
    row(
        Menu::Add,
        1,
        "add_gravity_point",
        "Point gravity",
        "Adds a point that attracts, or repels when negative",
    )
    .session(SessionCommand::Add(Addition::GravityPoint))
    .icon('◎')
    .when(Session::has_scene),
    row(Menu::Add, 1, "add_drag", "Air drag", "Adds resistance against motion; makes the file Version 1.1")
        .session(SessionCommand::Add(Addition::Drag))
        .icon('💨')
        .when(Session::has_scene),
    //
    row(Menu::Simulation, 0, "reset", "Reset", "Goes back to the start of the scene as it is edited now")
        .session(SessionCommand::Reset)
        .icon('⏮')
        .keys(&[Shortcut::plain(Key::Char('R'))])
        .when(Session::can_reset),
    row(Menu::Simulation, 0, "event_back", "Event back", "Goes back to the previous event")
        .session(SessionCommand::EventBack)
        .icon('⏪')
        .keys(&[Shortcut::plain(Key::Char('B'))])
        .when(Session::can_step_back),
    row(Menu::Simulation, 0, "step_back", "Step back", "Goes back by one Δt")
        .session(SessionCommand::StepBack)
        .icon('⬅')
        .keys(&[Shortcut::plain(Key::Char(','))])
        .when(Session::can_step_back),
    row(
        Menu::Simulation,
        0,
        "play_pause",
        "Play or pause",
        "Runs Δt after Δt, or stops after the current event",
    )
    .session(SessionCommand::PlayPause)
    .icon('▶')
    .keys(&[Shortcut::plain(Key::Space)])
    .when(Session::can_run),
    row(Menu::Simulation, 0, "step_forward", "Step forward", "Goes on by one Δt")
        .session(SessionCommand::StepForward)
        .icon('➡')
        .keys(&[Shortcut::plain(Key::Char('.'))])
        .when(Session::can_run),
    row(Menu::Simulation, 0, "next_event", "Next event", "Goes on to the next event, also inside a Δt")
        .session(SessionCommand::NextEvent)
        .icon('⏩')
        .keys(&[Shortcut::plain(Key::Char('N'))])
        .when(Session::can_run),
    row(
        Menu::Simulation,
        0,
        "finish_step",
        "Finish this Δt",
        "Goes on to the end of the Δt that an event opened",
    )
    .session(SessionCommand::FinishStep)
    .icon('⏭')
    .keys(&[Shortcut::plain(Key::End)])
    .when(Session::can_finish_step),
    row(
        Menu::Simulation,
        1,
        "next_event_of_selection",
        "Next event of the selection",
        "Goes on to the next event of what is selected",
    )
    .session(SessionCommand::Travel(TravelCommand::NextEventOfSelection))
    .keys(&[Shortcut::shift(Key::Char('N'))])
    .when(Session::can_find_its_events),
    row(
        Menu::Simulation,
        1,
        "event_back_of_selection",
        "Event of the selection back",
        "Goes back to the last event of what is selected",
    )
    .session(SessionCommand::Travel(TravelCommand::EventBackOfSelection))
    .keys(&[Shortcut::shift(Key::Char('B'))])
    .when(Session::can_go_to_its_events),
    row(Menu::Simulation, 1, "run_to_rest", "Run until all is at rest", "Goes on until no body moves")
        .session(SessionCommand::Travel(TravelCommand::RunToRest))
        .when(Session::can_run),
    row(Menu::Simulation, 1, "play_back", "Play backwards", "Plays backwards, or stops")
        .session(SessionCommand::Travel(TravelCommand::PlayBack))
        .keys(&[Shortcut::shift(Key::Space)])
        .when(Session::can_step_back),
    row(Menu::Simulation, 1, "go_to_begin", "Begin of the recording", "Shows the first time that is kept")
        .session(SessionCommand::Travel(TravelCommand::GoToBegin))
        .keys(&[Shortcut::plain(Key::Home)])
        .when(Session::can_step_back),
    row(Menu::Simulation, 1, "go_to_end", "End of the recording", "Shows the last time reached")
        .session(SessionCommand::Travel(TravelCommand::GoToEnd))
        .keys(&[Shortcut::shift(Key::End)])
        .when(Session::can_go_to_end),
    row(Menu::Simulation, 1, "step_forward_five", "Five steps forward", "Goes on by five Δt")
        .session(SessionCommand::StepForwardFive)
        .keys(&[Shortcut::shift(Key::Char('.'))])
        .when(Session::can_run),
    row(Menu::Simulation, 1, "step_back_five", "Five steps back", "Goes back by five Δt")
        .session(SessionCommand::StepBackFive)
        .keys(&[Shortcut::shift(Key::Char(','))])
        .when(Session::can_step_back),
    row(Menu::Simulation, 2, "faster", "Faster", "Doubles the speed of playing")
        .session(SessionCommand::Faster)
        .keys(&[Shortcut::plain(Key::Char('+'))]),
    row(Menu::Simulation, 2, "slower", "Slower", "Halves the speed of playing")
        .session(SessionCommand::Slower)
        .keys(&[Shortcut::plain(Key::Char('-'))]),
    row(Menu::Simulation, 3, "add_bookmark", "Add bookmark", "Marks this moment on the timeline")
        .session(SessionCommand::Travel(TravelCommand::AddBookmark))
        .keys(&[Shortcut::plain(Key::Char('K'))])
        .when(Session::can_run),
    row(Menu::Simulation, 3, "next_bookmark", "Next bookmark", "Shows the next moment that is marked")
        .session(SessionCommand::Travel(TravelCommand::NextBookmark))
        .keys(&[Shortcut::plain(Key::Char(']'))])
        .when(Session::can_go_to_next_bookmark),
    row(Menu::Simulation, 3, "last_bookmark", "Last bookmark", "Shows the last moment that is marked")
        .session(SessionCommand::Travel(TravelCommand::LastBookmark))
        .keys(&[Shortcut::plain(Key::Char('['))])
        .when(Session::can_go_to_last_bookmark),
    row(
        Menu::Simulation,
        3,
        "bring_back",
        "Bring back the replaced future",
        "Takes the last edit in the past out of the run: what it replaced is the future again",
    )
    .session(SessionCommand::Travel(TravelCommand::BringBack))
    .when(Session::can_bring_back),
];

/// The row of a command; `None` for those that other tables list (samples, recent files, overlays).
pub fn info(command: impl Into<Command>) -> Option<&'static CommandInfo> {
    let command = command.into();
    COMMANDS.iter().find(|row| row.command == command)
}
