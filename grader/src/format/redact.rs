//! Removes from a score what students may not see and sanitizes the rest.

use judging::sanitize::{sanitize, sanitize_line};

use crate::format::item_view::{ItemView, shows_everything};
use crate::format::sentence::sentence;
use crate::policy::Visibility;
use crate::score::rerun_command::RerunCommand;
use crate::score::{
    BuildReport, Evidence, FileReport, ItemScore, Score, TaskScore, Timings, Verdict, VerdictKind,
};

/// Returns the score without the parts that students may not see now. Every field is listed here,
/// so that a new field isn't shown before someone decides who may see it.
pub(super) fn visible_score(score: &Score, items: &[ItemView]) -> Score {
    Score {
        schema: score.schema,
        submission: sanitize_line(&score.submission, usize::MAX),
        exam: score.exam.clone(),
        isolation: score.isolation,
        complete: score.complete,
        // Students run the grader again on their own machines, where their own submission is the
        // default.
        rerun_command: RerunCommand::default(),
        book: None,
        bundle: score.bundle.clone(),
        assignment_title: score.assignment_title,
        points: score.points,
        max_points: score.max_points,
        tasks: score
            .tasks
            .iter()
            .map(|task| visible_task(task, items))
            .collect(),
        // The compiler ran before any question was sent, so its messages cannot repeat any of them.
        build: sanitized_build(&score.build),
        timings: if shows_everything(items) {
            score.timings.clone()
        } else {
            Timings::default()
        },
    }
}

fn visible_task(task: &TaskScore, items: &[ItemView]) -> TaskScore {
    let of_task: Vec<&ItemView> = items.iter().filter(|entry| entry.task == task.id).collect();
    let mut all_open = of_task.iter();
    let all_open = all_open.all(|entry| entry.visibility == Visibility::All);
    TaskScore {
        id: task.id,
        title: task.title.clone(),
        chapter: task.chapter.clone(),
        points: task.points,
        max_points: task.max_points,
        items: items_shown_now(task, &of_task),
        method: task.method.clone(),
        methods: task.methods.clone(),
        warnings: task
            .warnings
            .iter()
            .map(|warning| sanitize_line(warning, usize::MAX))
            .collect(),
        // Printed text may repeat the questions.
        printed: task
            .printed
            .as_ref()
            .filter(|_| all_open)
            .map(|printed| sanitize(printed, usize::MAX)),
    }
}

/// Removes from an item everything that students may not see at this visibility, including the ids
/// of `hidden` items. Every field is listed here, so that a new field isn't shown before someone
/// decides who may see it.
pub(super) fn redact(item: &ItemScore, visibility: Visibility, hidden: &[String]) -> ItemScore {
    let verdict = without_hidden_id(&item.verdict, hidden);
    let sentence = sentence(&verdict, item.carried_forward);
    match visibility {
        Visibility::All => {
            let names_hidden = |text: &str| hidden.iter().any(|id| text.contains(id));
            let message = if names_hidden(&item.message) {
                &sentence
            } else {
                &item.message
            };
            ItemScore {
                message: sanitize(message, usize::MAX),
                verdict,
                symptom_clue: (item.symptom_clue.clone()).filter(|clue| !names_hidden(clue)),
                evidence: item.evidence.as_ref().map(sanitized_evidence),
                staff: None,
                ..item.clone()
            }
        }
        Visibility::Points | Visibility::Hidden => redact_to_points(item),
        Visibility::Feedback | Visibility::AfterDue | Visibility::AfterPublished => ItemScore {
            id: item.id.clone(),
            title: item.title.clone(),
            points: item.points,
            max_points: item.max_points,
            message: sentence,
            at: None,
            look: (item.look.clone()).filter(|_| verdict.kind() == VerdictKind::Failed),
            verdict,
            // A program could choose which clue is shown, and so reveal a question.
            clue: None,
            section: item.section.clone(),
            symptom_clue: None,
            clue_section: None,
            symptom: None,
            wrong_answers: None,
            called: None,
            hints: item.hints.clone(),
            evidence: None,
            carried_forward: item.carried_forward,
            pictures: Vec::new(),
            staff: None,
        },
    }
}

fn sanitized_evidence(evidence: &Evidence) -> Evidence {
    Evidence {
        number: evidence.number,
        asked: sanitize(&evidence.asked, usize::MAX),
        got: sanitize(&evidence.got, usize::MAX),
        wanted: sanitize(&evidence.wanted, usize::MAX),
        can_be_shown: evidence.can_be_shown,
    }
}

fn sanitized_build(build: &BuildReport) -> BuildReport {
    let file = |file: &FileReport| FileReport {
        file: sanitize_line(&file.file, usize::MAX),
        line: file.line,
        message: sanitize(&file.message, usize::MAX),
        is_missing: file.is_missing,
    };
    let notes = |notes: &[String]| {
        let notes = notes.iter();
        notes.map(|note| sanitize_line(note, usize::MAX)).collect()
    };
    BuildReport {
        not_compiled: build.not_compiled.iter().map(file).collect(),
        ignored_copies: notes(&build.ignored_copies),
        notes: notes(&build.notes),
    }
}

/// Replaces the id of a hidden item with the id of its task.
fn without_hidden_id(verdict: &Verdict, hidden: &[String]) -> Verdict {
    if let Verdict::Blocked { by } = verdict
        && hidden.contains(by)
    {
        let by = by.split('.').next().unwrap_or_default().to_owned();
        return Verdict::Blocked { by };
    }
    verdict.clone()
}

/// Keeps only an item's id, title and points, and a verdict derived from the points.
fn redact_to_points(item: &ItemScore) -> ItemScore {
    let is_pending = item.verdict == Verdict::Pending;
    ItemScore {
        points: item.points,
        verdict: verdict_from_points(is_pending, item.points, item.max_points),
        ..ItemScore::pending(&item.id, &item.title, item.max_points)
    }
}

fn verdict_from_points(is_pending: bool, points: u32, max_points: u32) -> Verdict {
    match points {
        _ if is_pending => Verdict::Pending,
        0 => Verdict::Wrong,
        _ if points < max_points => Verdict::Partial,
        _ => Verdict::Pass,
    }
}

/// Returns the items of a task that students may see now, plus one item that combines all hidden
/// items.
fn items_shown_now(task: &TaskScore, of_task: &[&ItemView]) -> Vec<ItemScore> {
    let (open, hidden): (Vec<&ItemView>, Vec<&ItemView>) = of_task
        .iter()
        .partition(|entry| entry.visibility.is_shown_now());
    let mut items: Vec<ItemScore> = open.iter().map(|entry| entry.item.clone()).collect();
    let hidden: Vec<&ItemScore> = hidden.iter().map(|entry| &entry.item).collect();
    let Some(first) = hidden.first() else {
        return items;
    };
    let is_pending = hidden.iter().any(|item| item.verdict == Verdict::Pending);
    let points = hidden.iter().map(|item| item.points).sum();
    let max_points = hidden.iter().map(|item| item.max_points).sum();
    items.push(ItemScore {
        id: format!("{}.not_shown", task.id),
        title: match hidden.len() {
            1 => "one item that is not shown".to_owned(),
            count => format!("{count} items that are not shown"),
        },
        points,
        max_points,
        verdict: verdict_from_points(is_pending, points, max_points),
        ..ItemScore::pending(&first.id, &first.title, max_points)
    });
    items
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::format::StudentView;
    use crate::format::tests::sample;

    fn item<'a>(view: &'a StudentView, id: &str) -> &'a ItemScore {
        let mut items = view.visible.items();
        items.find(|item| item.id == id).unwrap()
    }

    /// The sample has a value for each field at each visibility.
    #[test]
    fn students_see_what_the_policy_allows() {
        let view = sample::restricted();
        let visible = serde_json::to_value(&view.visible).unwrap();
        insta::assert_snapshot!("restricted", format!("{visible:#}"));
    }

    #[test]
    fn nothing_but_text_for_people_changes_in_an_open_exam() {
        let (score, view) = (sample::score(), sample::open());
        for (own, shown) in score.items().zip(view.visible.items()) {
            let mut expected = own.clone();
            expected.staff = None;
            expected.evidence = own.evidence.as_ref().map(sanitized_evidence);
            assert_eq!(*shown, expected);
        }
        let evidence = item(&view, "camera.unit_length").evidence.as_ref();
        assert_eq!(evidence.unwrap().asked, "pixel\\u{1b}[2J (1, 2)");
        assert_eq!(view.visible.rerun_command, RerunCommand::default());
    }

    /// Students already know the ids of items that aren't hidden.
    #[test]
    fn only_a_hidden_item_is_named_by_its_task() {
        let hidden = ["bbox.flat".to_owned()];
        for (id, named) in [("bbox.flat", "bbox"), ("bbox.slabs", "bbox.slabs")] {
            let [blocked, expected] = [id, named].map(|by| Verdict::Blocked { by: by.to_owned() });
            assert_eq!(without_hidden_id(&blocked, &hidden), expected);
        }
    }

    /// Printed text may repeat the questions of any item.
    #[test]
    fn printed_text_is_shown_only_if_all_items_of_its_task_are_open() {
        let printed = |policy: &str| -> Vec<String> {
            let view = sample::view(&sample::score(), policy, 0);
            let tasks = view.visible.tasks.iter();
            tasks.filter_map(|task| task.printed.clone()).collect()
        };
        let (camera, sphere) = ("camera \\u{7}printed this", "sphere printed this");
        assert_eq!(printed(""), [camera, sphere]);
        let one_hidden = "[visibility.items]\n'sphere.near_side' = 'feedback'";
        assert_eq!(printed(one_hidden), [camera]);
    }

    #[test]
    fn a_verdict_follows_from_points() {
        let verdicts = [0, 1, 2, 3].map(|points| verdict_from_points(false, points, 3));
        let partial = Verdict::Partial;
        let expected = [Verdict::Wrong, partial.clone(), partial, Verdict::Pass];
        assert_eq!(verdicts, expected);
        assert_eq!(verdict_from_points(false, 0, 0), Verdict::Wrong);
    }

    #[test]
    fn points_alone_still_tell_that_an_item_is_not_graded() {
        for (level, id, verdict) in [
            ("points", "traverse.any_hit", Verdict::Pending),
            ("points", "traverse.closest_hit", Verdict::Wrong),
            ("hidden", "traverse.not_shown", Verdict::Pending),
        ] {
            let policy = format!("[visibility.items]\ntraverse = '{level}'");
            let score = sample::of_final_exam(sample::unfinished_score());
            assert_eq!(item(&sample::view(&score, &policy, 0), id).verdict, verdict);
        }
    }

    #[test]
    fn hidden_items_pass_together_if_each_of_them_does() {
        let hidden = |score: Score| {
            let policy = "[visibility]\nfinal = 'hidden'";
            sample::view(&sample::of_final_exam(score), policy, 0)
        };
        let perfect = hidden(sample::perfect_score());
        let mut all = perfect.visible.items();
        assert!(all.all(|item| item.verdict == Verdict::Pass));
        let partial = hidden(sample::score());
        let verdict = |id| item(&partial, id).verdict.clone();
        assert_eq!(verdict("sphere.not_shown"), Verdict::Partial);
        assert_eq!(verdict("triangle.not_shown"), Verdict::Wrong);
        let bbox = item(&partial, "bbox.not_shown");
        assert_eq!(bbox.title, "one item that is not shown");
        let sphere = item(&partial, "sphere.not_shown");
        assert_eq!(sphere.title, "3 items that are not shown");
        assert_eq!((sphere.points, sphere.max_points), (3, 5));
    }
}
