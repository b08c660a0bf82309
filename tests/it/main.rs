//! One binary with all integration tests: it links once. Each module holds one contract.

#![allow(
    clippy::approx_constant,
    clippy::disallowed_methods,
    clippy::expect_used,
    clippy::panic,
    clippy::unwrap_used,
    reason = "a test fails by stopping; expected values need not be the same bits everywhere; files round pi"
)]

// The command line through the real program: formats, exit codes, streams, hostile files.
mod cli;
// Shared helpers: scenes, driving, the reference.
mod common;
// Troubles of a scene as one designs it, and what puts them right.
mod design_repair;
// The table of tools: parts, arrays, order, selections, groups.
mod design_tools;
// Copies, tools, groups and repairs in a session.
mod editor_building;
// The command table: unique names and keys, reasons for what is disabled.
mod editor_commands;
// Killed while editing and saving, and a full disk.
mod editor_crash;
// Opening, saving, samples and the guards against losing or overwriting work.
mod editor_files;
// What an edit means for a simulation that runs.
mod editor_live;
// Selection, inspector fields, problems, new objects, clipboard, typed numbers.
mod editor_model;
// Random commands, edits and tools: undo, redo, save and reload.
mod editor_random;
// Random drags and commands, some ending in the middle of others.
mod editor_random_drags;
// Unsaved work outlives a crash.
mod editor_recovery;
// Other programs and windows on the open file.
mod editor_reload;
// The session beside its runner: files it writes, bookmarks, what it says, recordings that run again.
mod editor_run;
// A session with a runner that writes down what it is told.
mod editor_support;
// Undo: one point per gesture, the document alone.
mod editor_undo;
// Everyday scenes: closed, without overlap, and a sample that meets every demand.
mod everyday;
// The verb `everyday` through the real program.
mod everyday_verb;
// Scenes for other programs: every sample in every format, reports, names, axes.
mod export;
// Spoiled bytes for every reader.
mod fuzz;
// The Accuracy panel: a study on its thread, its figures and files, and that it rests.
mod gui_accuracy;
// The error badge: what it says, and that a click goes to the event it names.
mod gui_badge;
// Building in the window: parts, formulas, groups, problems; a whole scene in few actions.
mod gui_building;
// Views: saved viewpoints, following a body, looking from one, flying, linked views.
mod gui_cameras;
// Panels of the window: moved, tabbed, given room, reset.
mod gui_dock;
// Editing in the window: by typing, by dragging, by commands, with undo.
mod gui_edit;
// Scenes for other programs out of the window and theirs into it.
mod gui_export;
// Files in the window: start card, open, save, unsaved changes, the window's own dialog.
mod gui_files;
// Handles in the views: found by name, dragged, typed into, each drag one undo point.
mod gui_gizmo;
// Heaps in the window: marks, status, chains, and why playing falls behind.
mod gui_heap;
// Pictures of the window: its views are drawn, and only when they change.
mod gui_picture;
// The order of the scene tree, by mouse and keyboard.
mod gui_order;
// The real program in a real window: open, edit, step, save, close; and without a display.
mod gui_real;
// The window's content without a window.
mod gui_support;
// Selecting in the views by drawing: rectangles, outlines, through and not.
mod gui_selecting;
// The timeline, the ledger, bookmarks.
mod gui_timeline;
// The text of the file beside the picture.
mod gui_xml;
// The window as a whole: selecting, stepping, events, overlays, problems, shortcuts, rest.
mod gui_window;
// What the window says back: refusals, Escape, snapping, markers, names.
mod gui_words;
// The hard cases: every figure within its limit at every Δt.
mod hard_cases;
// Every scene of the repository: the same bits for every Δt, tiling and file order.
mod hard_invariance;
// The verb `hard-cases` through the real program.
mod hard_verb;
// Scenes of other programs: places, masses, reports, errors, round trips.
mod import;
// The rules of the source tree: layers, file sizes, function sizes.
mod layering;
// Files of a layer import each other in one direction.
mod layering_circles;
// Runners with the methods that step by Δt: going back at the Δt of then.
mod record_methods;
// The event at which the residual changed most, and going back to it.
mod record_drift;
// Moving through a recorded run, in both directions.
mod record_travel;
// When recorded ways cross the faces of tiles.
mod record_cancelled;
mod record_crossings;
// Runners: the Δt grid, going back, edits with their stamps, playing.
mod record_runner;
// Pictures drawn in software without a window: silhouettes against their areas, depth order, caching.
mod render_pictures;
// The verb `render` through the real program: pictures of every scene, and ways in which it ends badly.
mod render_verb;
// Edits: the bytes each changes, what it refuses, keys.
mod scene_edit;
// The vocabulary of the format against reader, schemas and documentation.
mod scene_schema;
// Files: every sample, every encoding, what saving does to the disk.
mod scene_files;
// Elements that change their order, with their comments.
mod scene_order;
// One small file per rule of the reader, and what is said about each.
mod scene_invalid;
// Any bytes, any edits, any numbers.
mod scene_properties;
// The reader: values, defaults, labels, places.
mod scene_read;
// Friction and spin in files.
mod scene_rough;
// Many bodies: what an edit costs, and whether it is right.
mod scene_scale;
// Stepped groups: heaps come to rest, wake, and depend on nothing but the scene.
mod sim_dense;
// Capture at the core of an attractor.
mod sim_capture;
// Chains of impacts with known outcomes: head-on pairs, Newton's cradle, counting π.
mod sim_chain;
// Lasting contact: inclines, corners, edges, air, lifting off.
mod sim_contact;
// Bodies and forces changed while a simulation runs.
// Drag where a body turns round, against closed forms.
mod sim_drag;
mod sim_edits;
// Overlaps at the start, huge and tiny numbers, nothing at all.
mod sim_extremes;
// Contact that once stalled or came out wrong, each with its symptom and cause.
mod sim_faults;
// Fields: plunges, thin orbits, forces switched while running, forces of the user's own.
mod sim_fields;
// Motion between events: throw, Kepler ellipse, fall through air.
mod sim_flight;
// Several contacts at one instant: corners, trains of balls, a billiard break.
mod sim_group;
// Single impacts: bouncing, coming to rest, bullets, grazing passes.
mod sim_impact;
// Δt, tiles, file order, looking and snapshots change no bit.
mod sim_invariance;
// The methods that step by Δt: what they get right, and what they lose.
mod sim_methods;
// Random scenes against all pairs, the reference and conservation laws.
mod sim_random;
// Numbers at the ends of their range: bounded work; other units: the same bits.
mod sim_range;
// Friction beyond a face: fixed balls, grooves, chains, air, a rack.
mod sim_rolling;
// Samples that rub: what they are to show, and that nothing is gained.
mod sim_rough_samples;
// Friction and spin: single balls on faces, impacts.
mod sim_spin;
// Times of impact against bisection, at the rims of plates and spheres.
mod sim_roots;
// Stiff friction, from seeds: no fault, no crowd of events, nothing gained.
mod sim_stiff_slips;
// Rough balls in rooms, from seeds: no fault, nothing gained, the books close.
mod sim_rubbing_rooms;
// Scenes scaled by powers of two in length, time and mass give the scaled bits.
mod sim_scale;
// Seams and edges under bodies whose way is integrated: no ghost impacts, no kink inside a step.
mod sim_seams;
// One ball where rounding decides: seams, pits, corners.
mod sim_stuck;
// The thesis's own scene against the reference, and its invariants over a minute.
mod sim_thesis;
// Contact scenes from seeds: seams, corners, squeezes, slots, pits, heaps, at any size.
mod sim_variants;
// The core beside the reference where single balls rub: on faces and in impacts.
mod study_friction;
// The reference against closed forms and itself, and where it says that it cannot be trusted.
mod study_reference;
// Whole studies: exact comes out exact, wrong laws are found out, horizon, cancelling, files.
mod study_runs;
// Cameras: rays against projections, framing, zoom to the cursor, the six axis views.
mod view_camera;
// Dragging and snapping, round lengths and short numbers.
mod view_drag;
// Draw lists: what is in them, precision far from the origin, overlays, when they are built anew.
mod view_draw_list;
// Handles: where they are seen, which is under the pointer, what dragging one means, contact.
mod view_gizmo;
// Picking against brute force; what is hidden or see-through is passed over.
mod view_pick;
// Scenes that the tests of views and pictures share.
mod view_scenes;
// Which walls of a closed box are glass, from everywhere.
mod view_see_through;
