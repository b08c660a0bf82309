//! What is stored of stepped groups: columns over the dynamic bodies, the members, the list of pairs near each other.

use glam::DVec3;

use super::converge::Solution;
use super::rub::Rubbing;
use super::stepped::{Contact, Near, Stepped};
use super::sweep::System;
use crate::sim::body::BodyId;
use crate::sim::pair::Pair;

/// What a dynamic body is to stepped groups.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::sim) enum Role {
    /// It goes on from event to event.
    #[default]
    Outside,
    /// It is stepped; its place among the members.
    Member(u32),
    /// It lies still, in the resting component of this number.
    Frozen(u32),
}

/// What a body has been through in the last steps.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::sim) struct Activity {
    /// Its impacts, and those of them that lose energy.
    pub impacts: Decaying,
    pub lossy: Decaying,
    /// What it cost to resolve and integrate it with others, in steps of a group.
    pub work: Decaying,
    /// How often it went on in contact, or met several at once or in turn; and whom it met last.
    pub held: Decaying,
    pub met: Option<BodyId>,
    /// Time of the last lossy impact, s, and how many there were at that time.
    pub instant: f64,
    pub at_once: u32,
    /// Until when nobody looks for a crowd around it again, s: the last look was in vain.
    pub alone_until: f64,
}

/// A sum of which half is forgotten in some time.
#[derive(Clone, Copy, Debug, Default)]
pub(in crate::sim) struct Decaying {
    pub sum: f64,
    /// When it had that value, s.
    pub last: f64,
}

/// A body that is stepped.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Member {
    pub body: u32,
    /// Where it was when the list was made, m, and how far it may go from there.
    pub listed_at: DVec3,
    pub margin: f64,
    /// Margin that it needs in the next list at least, m.
    pub widened: f64,
    /// How often its step is halved to converge, and how many steps in a row since then took few sweeps.
    pub halvings: u8,
    pub easy: u8,
    /// Energy that its component was given by what sweeps left, beyond what contacts took since, J.
    pub given: f64,
    /// Whether another dynamic body is listed with it.
    pub has_company: bool,
    /// Whether its segment is one of a group, which is a step of the leapfrog.
    pub is_stepped: bool,
    /// Steps without a push by another that moves, or by anything while it is to stay.
    pub idle: u32,
    /// For how many steps it is to stay while it lies on something, for events did not get on with it.
    pub stays: u32,
    /// Where it was when it last moved by more than what counts as still, m, and when, s.
    pub anchor: DVec3,
    pub still_since: f64,
    /// Number of the group that it entered with.
    pub group: u64,
}

/// Two bodies near each other, of which one at least is a member.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Listed {
    pub pair: Pair,
    /// Places among the members: of one of the two, and of the other, or [`FIXED`](super::stepped::FIXED).
    pub slots: [u32; 2],
}

/// Members connected by listed pairs, which are stepped together.
#[derive(Clone, Debug, Default)]
pub(super) struct Component {
    /// Places of the members.
    pub slots: Vec<u32>,
    /// Its listed pairs; of large components so that those which follow each other share no body.
    pub near: Vec<Near>,
    /// Places in the list of its pairs with bodies at rest.
    pub with_frozen: Vec<u32>,
    pub work: Work,
}

/// What the step at hand of a component came to. Between steps it is only memory to be used again.
#[derive(Debug, Default)]
pub(super) struct Work {
    pub bodies: Vec<Stepped>,
    pub contacts: Vec<Contact>,
    /// Places in `near` of those that are too far apart to count until they are seen to meet.
    pub waiting: Vec<u32>,
    pub system: System,
    pub rubbing: Rubbing,
    pub solution: Solution,
    /// Energy that sweeps have given it, J: see [`Member::given`].
    pub given: f64,
    /// s.
    pub end: f64,
    pub halvings: u8,
    /// How many of them it began with, and how many of those are kept from steps before, to converge.
    pub first_halvings: u8,
    pub kept_halvings: u8,
    /// Whether it lies still and comes to rest instead.
    pub is_still: bool,
}

impl Clone for Work {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// Two bodies that came to rest in contact.
#[derive(Clone, Copy, Debug)]
pub(in crate::sim) struct Held {
    pub pair: Pair,
    /// Force between them in the last step, N.
    pub force: f64,
}

/// All of it. There is none where a scene can have no groups.
#[derive(Clone, Debug)]
pub(in crate::sim) struct Dense {
    pub roles: Vec<Role>,
    pub activity: Vec<Activity>,
    /// In the order of their bodies.
    pub members: Vec<Member>,
    /// In order.
    pub pairs: Vec<Listed>,
    /// Forces of friction on the second bodies of the pairs in the last step, N; none where nothing rubs.
    pub rubs: Vec<DVec3>,
    /// In the order of their first bodies; as good as the list.
    pub(super) components: Vec<Component>,
    /// Grows with every new list, so that what was predicted for an old one can be told.
    pub epoch: u32,
    /// When the list was made, s.
    pub listed_since: f64,
    /// Whether members were added or taken since.
    pub is_list_stale: bool,
    /// Since when there have been members without a break, s.
    pub stepped_since: f64,
    /// Contacts of what lies still.
    pub held: Vec<Held>,
    /// Bodies that join at the next step.
    pub waiting: Vec<u32>,
    /// The earliest end of a member's step, s; infinite without members.
    pub next: f64,
    /// Number of the last component that came to rest.
    pub last_frozen: u32,
    pub frozen: usize,
    /// Whether all bodies begin anew, at the start or after an edit: that tells nothing of how they get on.
    pub is_beginning: bool,
}

impl Dense {
    pub fn new(bodies: usize) -> Self {
        Self {
            roles: vec![Role::Outside; bodies],
            activity: vec![Activity::default(); bodies],
            members: Vec::new(),
            pairs: Vec::new(),
            rubs: Vec::new(),
            components: Vec::new(),
            epoch: 0,
            listed_since: 0.0,
            is_list_stale: false,
            stepped_since: 0.0,
            held: Vec::new(),
            waiting: Vec::new(),
            next: f64::INFINITY,
            last_frozen: 0,
            frozen: 0,
            is_beginning: false,
        }
    }

    pub fn push_body(&mut self) {
        self.roles.push(Role::Outside);
        self.activity.push(Activity::default());
    }

    /// The listed pairs of the components, each with its place in the list and the force of the last step.
    pub(super) fn listed(&self) -> impl Iterator<Item = &Near> {
        self.components.iter().flat_map(|component| &component.near)
    }

    pub fn role(&self, body: u32) -> Role {
        self.roles[body as usize]
    }

    pub fn is_member(&self, body: u32) -> bool {
        matches!(self.role(body), Role::Member(_))
    }

    /// Numbers the members anew after some were added or taken.
    pub fn renumber(&mut self) {
        self.members.sort_unstable_by_key(|member| member.body);
        for (slot, member) in (0..).zip(&self.members) {
            self.roles[member.body as usize] = Role::Member(slot);
        }
        self.is_list_stale = true;
    }
}
