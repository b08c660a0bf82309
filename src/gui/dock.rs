//! The panels of the window, which can be moved, put behind each other and split, and where they are.

use egui::{Rect, Ui, Vec2, WidgetText, vec2};
use egui_tiles::{
    Behavior, Container, Linear, LinearDir, SimplificationOptions, TileId, Tiles, Tree, UiResponse,
};
use serde::{Deserialize, Serialize};

/// What has a place of its own in the window.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Panel {
    Tree,
    Inspector,
    Events,
    Problems,
    Accuracy,
    Xml,
    /// The n-th view.
    View(usize),
}

impl Panel {
    const ALL: [Self; 10] = [
        Self::Tree,
        Self::Inspector,
        Self::Events,
        Self::Problems,
        Self::Accuracy,
        Self::Xml,
        Self::View(0),
        Self::View(1),
        Self::View(2),
        Self::View(3),
    ];
}

/// What the panels hold.
pub trait Contents {
    fn title(&self, panel: Panel) -> String;

    /// Shows a panel; whether it is dragged elsewhere by a grip of its own.
    fn show(&mut self, ui: &mut Ui, panel: Panel) -> bool;

    /// At the right of a row of tabs whose front is `panel`.
    fn beside_tabs(&mut self, ui: &mut Ui, panel: Panel);
}

/// Where the panels are.
pub struct Dock {
    tree: Tree<Panel>,
    /// The room they had last.
    room: Option<Vec2>,
}

/// Room of the panels beside the views in a new window, points.
const TREE_WIDTH: f32 = 228.0;
const INSPECTOR_WIDTH: f32 = 344.0;
const LISTS_HEIGHT: f32 = 200.0;
/// Of the whole, as the shares of a new layout count it.
const WHOLE: Vec2 = vec2(1280.0, 680.0);

/// Height of a row of tabs.
const TABS_HEIGHT: f32 = 24.0;

impl Dock {
    /// The layout that was saved, if it has all panels there are.
    pub fn new(saved: Option<Tree<Panel>>) -> Self {
        match saved.filter(is_whole) {
            Some(tree) => Self { tree, room: None },
            None => Self { tree: usual(), room: None },
        }
    }

    /// The usual layout again.
    pub fn reset(&mut self) {
        *self = Self { tree: usual(), room: self.room.map(|_| WHOLE) };
    }

    pub fn saved(&self) -> Tree<Panel> {
        self.tree.clone()
    }

    /// Brings a panel to the front of those it lies behind.
    pub fn bring_to_front(&mut self, panel: Panel) {
        self.tree.make_active(|_, tile| matches!(tile, egui_tiles::Tile::Pane(found) if *found == panel));
    }

    /// Both of the next two.
    pub fn show_tall(&mut self, panel: Panel, height: f32) {
        self.bring_to_front(panel);
        self.give_height(panel, height);
    }

    /// Gives the row of a column that holds a panel at least a height, at the cost of the row with the views:
    /// for a panel that was asked for and needs the room. Nothing when it is elsewhere.
    pub fn give_height(&mut self, panel: Panel, height: f32) {
        let tiles = &mut self.tree.tiles;
        let Some(mut child) = tiles.find_pane(&panel) else { return };
        while let Some(parent) = tiles.parent_of(child) {
            if let Some(Container::Linear(linear)) = tiles.get_container(parent)
                && linear.dir == LinearDir::Vertical
                && let Some(views) = linear.children.iter().copied().find(|other| holds_views(tiles, *other))
                && let Some(now) = tiles.rect(child).map(|rect| rect.height())
            {
                let total: f32 =
                    linear.children.iter().filter_map(|id| Some(tiles.rect(*id)?.height())).sum();
                let more = (height - now).min(0.4 * total).max(0.0);
                let of = |id: TileId| tiles.rect(id).map_or(0.0, |rect| rect.height());
                let lengths: Vec<(TileId, f32)> = linear
                    .children
                    .iter()
                    .map(|id| {
                        let change = if *id == child {
                            more
                        } else if *id == views {
                            -more
                        } else {
                            0.0
                        };
                        (*id, of(*id) + change)
                    })
                    .collect();
                if let Some(egui_tiles::Tile::Container(Container::Linear(linear))) = tiles.get_mut(parent) {
                    lengths.into_iter().for_each(|(id, length)| linear.shares.set_share(id, length));
                }
                return;
            }
            child = parent;
        }
    }

    /// Shows the panels in what is left of the window; of the views those that `is_shown` says.
    pub fn show(&mut self, ui: &mut Ui, contents: &mut dyn Contents, is_shown: impl Fn(usize) -> bool) {
        for panel in Panel::ALL {
            if let (Panel::View(index), Some(tile)) = (panel, self.tree.tiles.find_pane(&panel)) {
                self.tree.set_visible(tile, is_shown(index));
            }
        }
        self.give_room_to_views(ui.available_size());
        let bare = self.views_alone();
        self.tree.ui(&mut Frame { contents, bare }, ui);
    }

    /// Rows of tabs that hold one view and nothing else.
    fn views_alone(&self) -> Vec<TileId> {
        let tiles = &self.tree.tiles;
        let alone = |tile: &TileId| match tiles.get_container(*tile) {
            Some(Container::Tabs(tabs)) => match tabs.children.as_slice() {
                [only] => matches!(tiles.get_pane(only), Some(Panel::View(_))),
                _ => false,
            },
            _ => false,
        };
        tiles.tile_ids().filter(alone).collect()
    }

    /// When the window changes its size the views do, and the panels beside them keep theirs.
    fn give_room_to_views(&mut self, room: Vec2) {
        let before = self.room.replace(room).unwrap_or(WHOLE);
        if before != room
            && let Some(root) = self.tree.root
        {
            resize(&mut self.tree.tiles, root, before, room);
        }
    }
}

/// Gives the children of a row or column their lengths as shares, of which only the one with views takes up
/// the change; and so on inside it.
fn resize(tiles: &mut Tiles<Panel>, tile: TileId, before: Vec2, now: Vec2) {
    let Some(Container::Linear(linear)) = tiles.get_container(tile) else { return };
    let along = |size: Vec2| if linear.dir == LinearDir::Horizontal { size.x } else { size.y };
    let children = linear.children.clone();
    let lengths = linear.shares.split(&children, along(before).max(1.0));
    let Some(views) = children.iter().position(|child| holds_views(tiles, *child)) else { return };
    let others: f32 = lengths.iter().sum::<f32>() - lengths[views];
    let left = (along(now) - others).max(0.3 * along(now));
    let (horizontal, child) = (linear.dir == LinearDir::Horizontal, children[views]);
    let inside = |all: Vec2, length: f32| if horizontal { vec2(length, all.y) } else { vec2(all.x, length) };
    if let Some(egui_tiles::Tile::Container(Container::Linear(linear))) = tiles.get_mut(tile) {
        for (at, (child, length)) in children.iter().zip(&lengths).enumerate() {
            linear.shares.set_share(*child, if at == views { left } else { *length });
        }
    }
    resize(tiles, child, inside(before, lengths[views]), inside(now, left));
}

fn holds_views(tiles: &Tiles<Panel>, tile: TileId) -> bool {
    match tiles.get(tile) {
        Some(egui_tiles::Tile::Pane(panel)) => matches!(panel, Panel::View(_)),
        Some(egui_tiles::Tile::Container(container)) => {
            container.children().any(|child| holds_views(tiles, *child))
        }
        None => false,
    }
}

/// Tree, views above lists, inspector.
fn usual() -> Tree<Panel> {
    let mut tiles = Tiles::default();
    let tabbed = |tiles: &mut Tiles<Panel>, panels: &[Panel]| {
        let panes = panels.iter().map(|panel| tiles.insert_pane(*panel)).collect();
        tiles.insert_tab_tile(panes)
    };
    let views: [TileId; 4] = std::array::from_fn(|index| tabbed(&mut tiles, &[Panel::View(index)]));
    let views = tiles.insert_grid_tile(views.to_vec());
    let lists = tabbed(&mut tiles, &[Panel::Events, Panel::Problems, Panel::Accuracy, Panel::Xml]);
    let middle =
        linear(&mut tiles, LinearDir::Vertical, WHOLE.y, &[(views, None), (lists, Some(LISTS_HEIGHT))]);
    let tree = tabbed(&mut tiles, &[Panel::Tree]);
    let inspector = tabbed(&mut tiles, &[Panel::Inspector]);
    let row = [(tree, Some(TREE_WIDTH)), (middle, None), (inspector, Some(INSPECTOR_WIDTH))];
    let root = linear(&mut tiles, LinearDir::Horizontal, WHOLE.x, &row);
    Tree::new(egui::Id::unique("dock"), root, tiles)
}

/// A row or column of a length, with the lengths of its children; one without takes what is left.
fn linear(
    tiles: &mut Tiles<Panel>,
    dir: LinearDir,
    whole: f32,
    children: &[(TileId, Option<f32>)],
) -> TileId {
    let mut linear = Linear::new(dir, children.iter().map(|(child, _)| *child).collect());
    let left = whole - children.iter().filter_map(|(_, length)| *length).sum::<f32>();
    for (child, length) in children {
        linear.shares.set_share(*child, length.unwrap_or(left));
    }
    tiles.insert_container(linear)
}

/// Whether a layout has every panel once, so that none is lost.
fn is_whole(tree: &Tree<Panel>) -> bool {
    let panes: Vec<Panel> = tree
        .tiles
        .tiles()
        .filter_map(|tile| match tile {
            egui_tiles::Tile::Pane(panel) => Some(*panel),
            egui_tiles::Tile::Container(_) => None,
        })
        .collect();
    tree.root.is_some()
        && panes.len() == Panel::ALL.len()
        && Panel::ALL.iter().all(|panel| panes.contains(panel))
}

/// How the layout looks and behaves.
struct Frame<'c> {
    contents: &'c mut dyn Contents,
    /// Rows of tabs that are not shown: a view alone has a title and a grip of its own.
    bare: Vec<TileId>,
}

impl Behavior<Panel> for Frame<'_> {
    fn pane_ui(&mut self, ui: &mut Ui, _: TileId, panel: &mut Panel) -> UiResponse {
        let rect = ui.max_rect();
        ui.set_clip_rect(rect.intersect(ui.clip_rect()));
        if self.contents.show(ui, *panel) { UiResponse::DragStarted } else { UiResponse::None }
    }

    fn tab_title_for_pane(&mut self, panel: &Panel) -> WidgetText {
        self.contents.title(*panel).into()
    }

    fn top_bar_right_ui(
        &mut self,
        tiles: &Tiles<Panel>,
        ui: &mut Ui,
        _: TileId,
        tabs: &egui_tiles::Tabs,
        _: &mut f32,
    ) {
        if let Some(panel) = tabs.active.and_then(|tile| tiles.get_pane(&tile)) {
            self.contents.beside_tabs(ui, *panel);
        }
    }

    fn is_tab_bar_visible(&self, tile: TileId, _: &egui_tiles::Tabs) -> bool {
        !self.bare.contains(&tile)
    }

    /// Two views side by side, four in two rows.
    fn grid_auto_column_count(&self, count: usize, _: Rect, _: f32) -> usize {
        if count < 2 { 1 } else { count.div_ceil(2).max(2) }
    }

    fn tab_bar_height(&self, _: &egui::Style) -> f32 {
        TABS_HEIGHT
    }

    fn gap_width(&self, _: &egui::Style) -> f32 {
        2.0
    }

    fn min_size(&self) -> f32 {
        60.0
    }

    fn simplification_options(&self) -> SimplificationOptions {
        SimplificationOptions {
            all_panes_must_have_tabs: true,
            prune_single_child_tabs: false,
            ..SimplificationOptions::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saved_layout_comes_back_unless_a_panel_is_missing() {
        let mut dock = Dock::new(None);
        dock.bring_to_front(Panel::Problems);
        let text = serde_json::to_string(&dock.saved()).unwrap();
        let again: Tree<Panel> = serde_json::from_str(&text).unwrap();
        assert!(again == dock.saved());
        let mut short = again.clone();
        let tile = short.tiles.find_pane(&Panel::Tree).unwrap();
        short.remove_recursively(tile);
        assert!(Dock::new(Some(short)).saved() == usual(), "the tree would be lost");
        assert!(Dock::new(Some(again.clone())).saved() == again);
    }

    #[test]
    fn only_the_views_take_up_the_change_of_a_window() {
        let mut tree = usual();
        let root = tree.root.unwrap();
        let now = vec2(WHOLE.x + 500.0, WHOLE.y - 100.0);
        resize(&mut tree.tiles, root, WHOLE, now);
        let lengths = |tiles: &Tiles<Panel>, tile: TileId, whole: f32| match tiles.get_container(tile) {
            Some(Container::Linear(linear)) => {
                (linear.children.clone(), linear.shares.split(&linear.children, whole))
            }
            _ => (Vec::new(), Vec::new()),
        };
        let (children, widths) = lengths(&tree.tiles, root, now.x);
        let close = |a: f32, b: f32| (a - b).abs() < 0.01;
        assert!(close(widths[0], TREE_WIDTH) && close(widths[2], INSPECTOR_WIDTH), "{widths:?}");
        let (_, heights) = lengths(&tree.tiles, children[1], now.y);
        assert!(close(heights[1], LISTS_HEIGHT) && close(heights[0], now.y - LISTS_HEIGHT), "{heights:?}");
    }
}
