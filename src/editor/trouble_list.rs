//! What is wrong with the scene as one designs it, found once for each state of the document.

use std::cell::RefCell;
use std::sync::Arc;

use crate::design::{self, Trouble};
use crate::scene::Scene;

/// What is wrong with the scene, kept until the document is another one.
#[derive(Default)]
pub(super) struct TroubleList(RefCell<Option<Found>>);

/// The document, and what was found in it.
type Found = ((u64, u64), Arc<[Trouble]>);

impl TroubleList {
    pub fn of(&self, document: (u64, u64), scene: Option<&Scene>) -> Arc<[Trouble]> {
        let mut kept = self.0.borrow_mut();
        match &*kept {
            Some((of, list)) if *of == document => list.clone(),
            _ => {
                let list: Arc<[Trouble]> = scene.map(design::troubles).unwrap_or_default().into();
                *kept = Some((document, list.clone()));
                list
            }
        }
    }
}
