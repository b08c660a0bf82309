//! Keeps a view's draw list until something it depends on changes.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::{DrawList, ViewInput, build_draw_list};

/// One view's last draw list. Views that show the same thing need one each.
#[derive(Debug, Default)]
pub struct ListCache {
    key: Option<Key>,
    list: Option<Arc<DrawList>>,
}

/// What a picture depends on. The scene by the caller's revision, the frame by its own.
#[derive(Debug, PartialEq)]
struct Key {
    scene_revision: u64,
    frame_revision: Option<u64>,
    camera: super::Camera,
    viewport: super::Viewport,
    overlays: super::OverlaySet,
    theme: super::Theme,
    selection: Vec<crate::scene::NodeKey>,
    hovered: Option<crate::scene::NodeKey>,
    inside: Option<crate::scene::NodeKey>,
    highlighted: Option<u64>,
}

/// Numbers draw lists over all views, so that a renderer can tell any two apart.
static NEXT_REVISION: AtomicU64 = AtomicU64::new(1);

impl ListCache {
    /// The draw list of `input`; the same one as long as nothing changed. `scene_revision` must differ
    /// whenever `input.scene` does.
    pub fn get(&mut self, input: &ViewInput<'_>, scene_revision: u64) -> Arc<DrawList> {
        let key = Key {
            scene_revision,
            frame_revision: input.frame.map(|frame| frame.revision),
            camera: input.camera,
            viewport: input.viewport,
            overlays: input.overlays,
            theme: input.theme,
            selection: input.selection.to_vec(),
            hovered: input.hovered,
            inside: input.inside,
            highlighted: input.highlighted.map(|row| row.event.seq),
        };
        match &self.list {
            Some(list) if self.key.as_ref() == Some(&key) => list.clone(),
            _ => {
                let mut list = build_draw_list(input);
                list.revision = NEXT_REVISION.fetch_add(1, Ordering::Relaxed);
                let list = Arc::new(list);
                (self.key, self.list) = (Some(key), Some(list.clone()));
                list
            }
        }
    }
}
