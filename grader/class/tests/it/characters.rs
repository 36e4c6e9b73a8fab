//! Characters that could affect the text around them, such as escape sequences and direction marks.
//! Nothing a student chooses may cause such characters to appear in the teacher's terminal, tables
//! or pages.

use std::collections::BTreeSet;

use class::entry::{Entry, EntryInfo, ListedTime, Person, Source};
use class::final_grades::GradeChanges;
use class::gradebook::{CellChange, FilledGradebook};
use class::graded_class::{Adjustments, ClassRow, GradedClass};
use class::hand_back::HandBack;
use class::hand_in_again;
use class::layout::{Layout, RecognisedClass, UnmatchedPath};
use class::manual_points::ManualPoints;
use class::outcome::{
    EntryOutcome, EntryResult, FileNotes, Hint, ItemScore, ScoreSummary, TaskScore,
};
use class::regrade_diff::{Changes, ItemChange, RegradeChanges, ScoreChange};
use class::report::grades::grades_table;
use class::report::page::render_page;
use class::report::preview::render_preview;
use class::report::text::{render_changes, render_gradebook, render_hand_back, render_summary};
use class::run::Settings;
use class::similar_pairs::{ComparedFile, SimilarPair};
use class::summary::ClassSummary;
use class::table::Table;
use grader::handed_out::RAYS;
use grader::policy::Policy;
use judging::sanitize::affects_surroundings;

/// Returns text with every character that could affect the text around it.
fn hostile_text() -> String {
    let characters = (0..=u32::from(char::MAX)).filter_map(char::from_u32);
    let hostile: String = characters.filter(|c| affects_surroundings(*c)).collect();
    format!("a{hostile}z")
}

fn info(text: &str) -> EntryInfo {
    EntryInfo {
        pseudonym: text.to_owned(),
        people: vec![Person {
            name: text.to_owned(),
            email: text.to_owned(),
            sid: text.to_owned(),
            login: text.to_owned(),
            number: text.to_owned(),
            group: text.to_owned(),
            section: text.to_owned(),
            extension: text.to_owned(),
            status: text.to_owned(),
            is_named_by_file: true,
            is_from_group: true,
            is_listed: true,
        }],
        late: true,
        submitted: Some(text.to_owned()),
        marks_late: true,
        is_corrected: true,
        needs_staff: false,
        unclear_person: None,
        is_unlisted: true,
        attempt: Some(2),
        listed: Some(ListedTime {
            submitted: text.to_owned(),
            late: true,
        }),
        from: text.to_owned(),
        hand_back_as: Some(text.to_owned()),
        team: Some(text.to_owned()),
    }
}

fn score(text: &str) -> ScoreSummary {
    let item = ItemScore {
        blocked_by: Some(text.to_owned()),
        id: text.to_owned(),
        title: text.to_owned(),
        points: 0,
        max_points: 1,
        verdict: "wrong".to_owned(),
        message: text.to_owned(),
        hints: vec![Hint {
            hint: text.to_owned(),
        }],
    };
    ScoreSummary {
        points: 0,
        max_points: 1,
        build: FileNotes::default(),
        tasks: vec![TaskScore {
            id: "sphere".to_owned(),
            title: text.to_owned(),
            points: 0,
            max_points: 1,
            items: vec![item],
        }],
    }
}

/// Returns a class that contains this text wherever a student can enter text.
fn class_with(text: &str) -> GradedClass {
    let outcomes = [
        EntryOutcome::Graded(Box::new(score(text))),
        EntryOutcome::NothingToGrade(text.to_owned()),
        EntryOutcome::Fault(text.to_owned()),
    ];
    let row = |outcome| {
        let (id, info) = (text.to_owned(), info(text));
        let manual = ManualPoints {
            row: 2,
            student: text.to_owned(),
            task: text.to_owned(),
            delta: 1,
            comment: text.to_owned(),
            author: text.to_owned(),
            date: text.to_owned(),
            is_for_attempt: false,
        };
        let result = EntryResult { id, info, outcome };
        let own = Adjustments {
            manual: vec![manual],
            ..Adjustments::default()
        };
        ClassRow::new(result, &Policy::default(), vec![own], &[])
    };
    GradedClass {
        settings: Settings {
            exam: text.to_owned(),
            exam_hash: text.to_owned(),
            isolation: text.to_owned(),
            ..Settings::default()
        },
        rows: outcomes.map(row).into(),
        missing: info(text).people,
    }
}

fn preview_with(text: &str) -> String {
    let entry = Entry {
        id: text.to_owned(),
        info: info(text),
        source: Source::Missing(text.to_owned()),
    };
    let class = RecognisedClass {
        layout: Layout::Canvas,
        // Two entries by the same person, which are reported.
        entries: vec![entry.clone(), entry],
        unmatched: vec![UnmatchedPath {
            name: text.to_owned(),
            why: text.to_owned(),
        }],
        notes: vec![text.to_owned()],
        mixtures: Vec::new(),
    };
    render_preview(&class, &info(text).people, &RAYS)
}

/// Returns everything that a teacher reads: the name and the text of each output.
fn outputs(text: &str) -> Vec<(&'static str, String)> {
    let class = class_with(text);
    let summary = ClassSummary::new(&class, &Policy::default(), &BTreeSet::new());
    let changes = vec![ScoreChange {
        id: text.to_owned(),
        was: 1,
        now: None,
        items: vec![ItemChange {
            item: text.to_owned(),
            was: None,
            now: None,
            why: text.to_owned(),
        }],
    }];
    let changes = Changes {
        regrade: Some(RegradeChanges {
            scores: changes.clone(),
            causes: Vec::new(),
        }),
        resubmitted: changes,
        removed: vec![text.to_owned()],
        grades: Some(GradeChanges {
            causes: Vec::new(),
            changes: vec![text.to_owned()],
        }),
    };
    let gradebook = FilledGradebook {
        title: text.to_owned(),
        table: Table::new(&["Name"], Vec::new()),
        changes: vec![CellChange {
            who: text.to_owned(),
            was: text.to_owned(),
            now: "1".to_owned(),
        }],
        warnings: vec![text.to_owned()],
    };
    let compared = ComparedFile {
        task: text.to_owned(),
        submission: text.to_owned(),
        lines: text.to_owned(),
        ..ComparedFile::default()
    };
    let similar = [SimilarPair {
        similarity: 1.0,
        files: [compared.clone(), compared],
    }];
    vec![
        (
            "class.html",
            render_page(&class, &summary, &changes, &similar),
        ),
        ("grades.csv", grades_table(&class).to_csv()),
        ("the summary", render_summary(&summary)),
        ("the changes", render_changes(&changes)),
        ("the changes of a gradebook", render_gradebook(&gradebook)),
        (
            "the archive to hand back",
            render_hand_back(&HandBack {
                archive: Vec::new(),
                pages: 0,
                left_out: vec![text.to_owned()],
            }),
        ),
        (
            "the message about handing in again",
            hand_in_again::render(&info(text).people[0], &[text.to_owned()], &RAYS),
        ),
        ("the preview", preview_with(text)),
    ]
}

#[test]
fn no_output_has_a_character_that_affects_the_text_around_it() {
    let hostile = hostile_text();
    for (output, text) in outputs(&hostile) {
        // Remove the escape sequences that style the headings in the terminal.
        let text = ["0", "1", "2"].iter().fold(text, |text, style| {
            text.replace(&format!("\u{1b}[{style}m"), "")
        });
        let is_dangerous = |c: &char| *c != '\n' && affects_surroundings(*c);
        let dangerous: Vec<char> = text.chars().filter(is_dangerous).collect();
        assert_eq!(dangerous, [] as [char; 0], "{output}: {text:?}");
        assert!(text.contains("\\u{1b}"), "{output} does not show the text");
    }
}
