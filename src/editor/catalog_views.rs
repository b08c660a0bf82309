//! The rows of the table of commands that are about views, panels and help.

use super::Session;
use super::command::{Key, Menu, Shortcut, ViewCommand, WindowCommand};
use super::command_info::{CommandInfo, row};
use crate::view::{AxisView, Pivot, Tool};

/// The menus View and Help.
pub(super) const VIEWING: &[CommandInfo] = &[
    row(
        Menu::View,
        0,
        "frame_selection",
        "Frame selection",
        "Brings the selection into the middle of the view",
    )
    .view(ViewCommand::FrameSelection)
    .icon('⌖')
    .keys(&[Shortcut::plain(Key::Char('F'))])
    .when(Session::has_selection),
    row(Menu::View, 0, "frame_all", "Frame all", "Brings the map and all bodies into the view")
        .view(ViewCommand::FrameAll)
        .icon('⛶')
        .keys(&[Shortcut::plain(Key::Char('A'))]),
    row(Menu::View, 0, "frame_map", "Frame the map", "Brings the box of the map into the view")
        .view(ViewCommand::FrameMap)
        .keys(&[Shortcut::shift(Key::Char('A'))]),
    row(
        Menu::View,
        0,
        "follow",
        "Follow a body",
        "The view moves with the body selected last, or no longer with the one it follows",
    )
    .view(ViewCommand::Follow)
    .keys(&[Shortcut::shift(Key::Char('F'))]),
    row(
        Menu::View,
        0,
        "look_from_body",
        "Look from a body",
        "Looks from the middle of the body selected last along its way, or goes back to where the view was",
    )
    .view(ViewCommand::LookFromBody)
    .keys(&[Shortcut::shift(Key::Char('E'))]),
    row(
        Menu::View,
        0,
        "fly_mode",
        "Fly",
        "Moves the eye by W, A, S, D, Q and E, turns it by the mouse, until Esc",
    )
    .view(ViewCommand::Fly)
    .keys(&[Shortcut::plain(Key::Char('V'))]),
    row(Menu::View, 1, "view_perspective", "Perspective", "Looks at the scene with perspective")
        .view(ViewCommand::Perspective)
        .keys(&[Shortcut::plain(Key::Char('1'))]),
    row(Menu::View, 1, "view_top", "Top", "Looks down on the scene, against y")
        .view(ViewCommand::Along(AxisView::Top))
        .keys(&[Shortcut::plain(Key::Char('2'))]),
    row(Menu::View, 1, "view_front", "Front", "Looks at the scene from the front, against z")
        .view(ViewCommand::Along(AxisView::Front))
        .keys(&[Shortcut::plain(Key::Char('3'))]),
    row(Menu::View, 1, "view_right", "Right", "Looks at the scene from the right, against x")
        .view(ViewCommand::Along(AxisView::Right))
        .keys(&[Shortcut::plain(Key::Char('4'))]),
    row(Menu::View, 1, "view_bottom", "Bottom", "Looks up at the scene, along y")
        .view(ViewCommand::Along(AxisView::Bottom))
        .keys(&[Shortcut::shift(Key::Char('2'))]),
    row(Menu::View, 1, "view_back", "Back", "Looks at the scene from behind, along z")
        .view(ViewCommand::Along(AxisView::Back))
        .keys(&[Shortcut::shift(Key::Char('3'))]),
    row(Menu::View, 1, "view_left", "Left", "Looks at the scene from the left, along x")
        .view(ViewCommand::Along(AxisView::Left))
        .keys(&[Shortcut::shift(Key::Char('4'))]),
    row(Menu::View, 1, "toggle_projection", "Parallel or perspective", "Switches the projection of the view")
        .view(ViewCommand::ToggleProjection)
        .keys(&[Shortcut::plain(Key::Char('P'))]),
    row(
        Menu::View,
        1,
        "link_axis_views",
        "Link the axis views",
        "Moves and magnifies all views along an axis together, with one place in the middle of all",
    )
    .view(ViewCommand::ToggleLinked),
    row(
        Menu::View,
        2,
        "maximize_view",
        "One view or four",
        "Fills the middle with the active view, or shows all four",
    )
    .view(ViewCommand::Maximize)
    .icon('⊞')
    .keys(&[Shortcut::plain(Key::Char('M'))]),
    row(Menu::View, 2, "show_one_view", "One view", "Shows the active view alone").view(ViewCommand::OneView),
    row(Menu::View, 2, "show_two_views", "Two views", "Shows the perspective and one view along an axis")
        .view(ViewCommand::TwoViews),
    row(Menu::View, 2, "show_four_views", "Four views", "Shows perspective, top, front and right")
        .view(ViewCommand::FourViews),
    row(
        Menu::View,
        3,
        "toggle_snapping",
        "Snap while dragging",
        "Dragged bodies stop at multiples of a round step that suits the magnification",
    )
    .view(ViewCommand::ToggleSnapping)
    .keys(&[Shortcut::plain(Key::Char('G'))]),
    row(
        Menu::View,
        3,
        "select_through",
        "Select through",
        "Rectangles and outlines take also what is hidden behind other bodies",
    )
    .view(ViewCommand::ToggleThrough),
    row(Menu::View, 4, "tool_select", "No handles", "Shows no handles: drags select, or move a body")
        .view(ViewCommand::Tool(Tool::Select))
        .keys(&[Shortcut::plain(Key::Char('Q'))]),
    row(
        Menu::View,
        4,
        "tool_move",
        "Move handles",
        "Shows arrows, squares and a disc that move the selection",
    )
    .view(ViewCommand::Tool(Tool::Move))
    .keys(&[Shortcut::plain(Key::Char('W'))]),
    row(Menu::View, 4, "tool_turn", "Turn handles", "Shows rings that turn the selection, velocities too")
        .view(ViewCommand::Tool(Tool::Turn))
        .keys(&[Shortcut::plain(Key::Char('E'))]),
    row(
        Menu::View,
        4,
        "tool_size",
        "Size handles",
        "Shows knobs that change a sphere's radius, a plate's sides or the map, or scale several things",
    )
    .view(ViewCommand::Tool(Tool::Size))
    .keys(&[Shortcut::plain(Key::Char('S'))]),
    row(
        Menu::View,
        4,
        "toggle_local_axes",
        "Body or world axes",
        "Turns the handles along the axes of the body selected last, or of the world",
    )
    .view(ViewCommand::ToggleLocalAxes)
    .keys(&[Shortcut::plain(Key::Char('L'))]),
    row(
        Menu::View,
        4,
        "pivot_middle",
        "Pivot in the middle",
        "Turns and scales several things about the mean of their centres",
    )
    .view(ViewCommand::Pivot(Pivot::Middle)),
    row(
        Menu::View,
        4,
        "pivot_last",
        "Pivot in the last selected",
        "Turns and scales several things about the one selected last",
    )
    .view(ViewCommand::Pivot(Pivot::Last)),
    row(
        Menu::View,
        4,
        "pivot_each",
        "Pivot in each",
        "Turns and scales every selected thing about its own centre",
    )
    .view(ViewCommand::Pivot(Pivot::Each)),
    row(Menu::View, 5, "show_accuracy", "Accuracy", "Shows speed against error of every method")
        .window(WindowCommand::ShowAccuracy),
    row(
        Menu::View,
        5,
        "show_xml",
        "XML text",
        "Shows the file as it would be saved, with what is selected marked",
    )
    .window(WindowCommand::ShowXml)
    .keys(&[Shortcut::ctrl('U')]),
    row(
        Menu::View,
        5,
        "show_costs",
        "Costs of events",
        "Shows with the events what the core did for each, and which predicted impacts the one shown cancelled",
    )
    .window(WindowCommand::ShowCosts),
    row(Menu::View, 5, "reset_layout", "Reset the panels", "Puts all panels where they are in a new window")
        .window(WindowCommand::ResetLayout),
    row(Menu::View, 5, "switch_colors", "Dark or light colours", "Switches the colours of the window")
        .window(WindowCommand::SwitchColors),
    //
    row(Menu::Help, 0, "help", "Help", "Explains the window in one page")
        .window(WindowCommand::Help)
        .icon('❓')
        .keys(&[Shortcut::plain(Key::Function(1))]),
    row(Menu::Help, 0, "shortcuts", "Keys and gestures", "Lists all keys and mouse gestures")
        .window(WindowCommand::Shortcuts)
        .keys(&[Shortcut::plain(Key::Char('?'))]),
    row(Menu::Help, 0, "palette", "Command palette…", "Finds a command by its name")
        .window(WindowCommand::Palette)
        .icon('🔍')
        .keys(&[Shortcut::ctrl('P')]),
    row(Menu::Help, 1, "about", "About PolyScene", "Shows the version, the licence and how to report a bug")
        .window(WindowCommand::About),
];
