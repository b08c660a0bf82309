//! Commands: what a user can ask for by menu, tool bar, key or palette, as plain data.

use std::fmt;

use crate::scene::NumberStyle;
use crate::view::{AxisView, Pivot, Tool};

/// Every user action that needs no further data, by who carries it out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Command {
    Session(SessionCommand),
    View(ViewCommand),
    Window(WindowCommand),
}

/// What [`super::Session`] carries out: files, edits, the transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SessionCommand {
    New(NumberStyle),
    Open,
    /// A scene of another program, which [`Self::Open`] takes too.
    Import,
    OpenSample(usize),
    OpenRecent(usize),
    Save,
    SaveAs,
    /// The run, for others to run it again.
    SaveRecording,
    Reload,
    Quit,

    Undo,
    Redo,
    Cut,
    Copy,
    Paste,
    /// Where the copies came from.
    PasteInPlace,
    Duplicate,
    Delete,
    SelectAll,
    SelectNone,
    /// Gathers the selection in a group of the tree.
    Group,
    Ungroup,
    /// In the tree, and in the file.
    MoveUp,
    MoveDown,
    Hide,
    ShowAll,
    Lock,
    UnlockAll,
    MakeIdsUnique,
    TakeStateAsStart,
    Add(Addition),

    Reset,
    PlayPause,
    StepForward,
    StepForwardFive,
    StepBack,
    StepBackFive,
    NextEvent,
    EventBack,
    FinishStep,
    Faster,
    Slower,
    Travel(TravelCommand),
}

/// Moving through what is recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TravelCommand {
    PlayBack,
    /// Of the selected body, or between two selected ones.
    NextEventOfSelection,
    EventBackOfSelection,
    RunToRest,
    /// To the ends of what is recorded.
    GoToBegin,
    GoToEnd,
    AddBookmark,
    NextBookmark,
    LastBookmark,
    /// What an edit in the past has replaced is the future again.
    BringBack,
}

/// New bodies and forces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addition {
    SphereDynamic,
    SphereStatic,
    Plane,
    GravityPlane,
    GravityPoint,
    Drag,
}

/// What the views carry out, most of it in the active one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ViewCommand {
    FrameSelection,
    FrameAll,
    FrameMap,
    /// Keeps what was selected last in its place in the view, or no longer.
    Follow,
    /// Puts the eye into what was selected last, or back.
    LookFromBody,
    /// Keys and mouse move through the scene until Escape.
    Fly,
    Perspective,
    Along(AxisView),
    Maximize,
    OneView,
    TwoViews,
    FourViews,
    ToggleProjection,
    /// Views along axes are moved and magnified together.
    ToggleLinked,
    ToggleSnapping,
    /// What the handles of the selection do.
    Tool(Tool),
    /// What several things are turned about, and grow from.
    Pivot(Pivot),
    /// Rectangles and outlines select what is hidden behind other bodies, too.
    ToggleThrough,
    /// Handles along the axes of the body, or of the world.
    ToggleLocalAxes,
    /// The n-th of [`crate::view::OVERLAYS`], in the active view.
    ToggleOverlay(usize),
}

/// What the window carries out: panels, dialogs, colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WindowCommand {
    /// Shows the panel that compares speed and errors of the methods.
    ShowAccuracy,
    /// Shows the panel with the text of the scene's file.
    ShowXml,
    /// Shows what the core did for each event, and what the one shown cancelled.
    ShowCosts,
    SwitchColors,
    /// All panels where they are in a new window.
    ResetLayout,
    /// Puts the keyboard into the filter of the scene tree.
    Find,
    /// The n-th of [`crate::design::TOOLS`]: at once, or by a dialog that asks for its sizes.
    DesignTool(usize),
    /// Opens the name of what was selected last for typing.
    Rename,
    /// Opens the dialog that writes the scene for another program; with the n-th of [`crate::export::FORMATS`] chosen.
    Export(Option<usize>),
    /// Opens the dialog with what the program remembers by choice.
    Settings,
    Help,
    Shortcuts,
    Palette,
    About,
}

impl ViewCommand {
    /// Whether it says where the active view looks.
    pub fn is_a_look(self) -> bool {
        matches!(
            self,
            Self::FrameSelection
                | Self::FrameAll
                | Self::FrameMap
                | Self::Perspective
                | Self::Along(_)
                | Self::ToggleProjection
        )
    }
}

impl From<SessionCommand> for Command {
    fn from(command: SessionCommand) -> Self {
        Self::Session(command)
    }
}

impl From<ViewCommand> for Command {
    fn from(command: ViewCommand) -> Self {
        Self::View(command)
    }
}

impl From<WindowCommand> for Command {
    fn from(command: WindowCommand) -> Self {
        Self::Window(command)
    }
}

/// What became of a command.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    Done,
    /// Why it could not be done; also given as a notice.
    Refused(String),
}

impl Outcome {
    pub(super) fn no_scene() -> Self {
        Self::Refused("The file has errors that leave no scene to edit".to_owned())
    }
}

/// The menu that lists a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Menu {
    File,
    Edit,
    Add,
    Simulation,
    View,
    Help,
}

impl Menu {
    pub const ALL: [Self; 6] = [Self::File, Self::Edit, Self::Add, Self::Simulation, Self::View, Self::Help];

    pub fn label(self) -> &'static str {
        match self {
            Self::File => "File",
            Self::Edit => "Edit",
            Self::Add => "Add",
            Self::Simulation => "Simulation",
            Self::View => "View",
            Self::Help => "Help",
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Key {
    /// A letter (upper case), digit or punctuation mark.
    Char(char),
    Space,
    Delete,
    Escape,
    End,
    Home,
    Up,
    Down,
    Function(u8),
}

/// A key with its modifiers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shortcut {
    pub key: Key,
    pub ctrl: bool,
    pub shift: bool,
}

impl Shortcut {
    pub const fn plain(key: Key) -> Self {
        Self { key, ctrl: false, shift: false }
    }

    pub const fn shift(key: Key) -> Self {
        Self { key, ctrl: false, shift: true }
    }

    pub const fn ctrl(letter: char) -> Self {
        Self { key: Key::Char(letter), ctrl: true, shift: false }
    }

    pub const fn ctrl_key(key: Key) -> Self {
        Self { key, ctrl: true, shift: false }
    }

    pub const fn ctrl_shift(letter: char) -> Self {
        Self { key: Key::Char(letter), ctrl: true, shift: true }
    }

    /// Whether it is meant for the application even while a text field has the keyboard.
    pub fn works_while_typing(self) -> bool {
        match self.key {
            Key::Function(_) => true,
            // these belong to the text itself
            Key::Char('A' | 'C' | 'V' | 'X' | 'Y' | 'Z') => false,
            Key::Char(_) => self.ctrl,
            _ => false,
        }
    }
}

impl fmt::Display for Shortcut {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.ctrl {
            f.write_str("Ctrl+")?;
        }
        if self.shift {
            f.write_str("Shift+")?;
        }
        match self.key {
            Key::Char(c) => write!(f, "{c}"),
            Key::Space => f.write_str("Space"),
            Key::Delete => f.write_str("Delete"),
            Key::Escape => f.write_str("Esc"),
            Key::End => f.write_str("End"),
            Key::Home => f.write_str("Home"),
            Key::Up => f.write_str("Up"),
            Key::Down => f.write_str("Down"),
            Key::Function(n) => write!(f, "F{n}"),
        }
    }
}
