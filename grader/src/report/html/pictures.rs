//! Renders the expected picture, the submitted picture and their differences.
//!
//! Without scripts, the page shows the pictures side by side. `page.js` adds the slider and the
//! flicker button.

use glam::UVec2;
use judging::describe;
use judging::exam::{Exam, Item};
use judging::picture::{self, LayerComparison, Picture, WorstPixel};
use maud::{Markup, html};
use protocol::{Answer, Question};

use super::elements::{command, evidence_table, plain_text};
use super::mask;
use crate::png_file::data_uri;
use crate::report::answers::ReportAnswers;
use crate::score::rerun_command::RerunCommand;

/// The width of the SVG that contains the marks, in its own units. It doesn't depend on the size of
/// the film.
const MARKS_WIDTH: f32 = 64.0;
/// The radius of a mark. The mask is 256 screen pixels wide, so a mark is large enough to click.
const MARK_RADIUS: f32 = 3.2;

/// Renders the pictures of a failed item, question by question.
pub(super) fn failing(item: &Item, answers: &ReportAnswers, rerun: &RerunCommand) -> Markup {
    let answered =
        (0..item.questions.len()).filter_map(|i| Some((i, answers.answer(&item.id, i)?)));
    let pictures = answered.filter_map(|(question, answer)| {
        Some(WrongPicture {
            item,
            question,
            picture: picture::compare(&item.questions[question], answer)?,
            rerun,
            answer,
        })
    });
    html! {
        @for picture in pictures { (picture.render()) }
    }
}

/// Renders the pictures of an item that passed. Only the submitted pictures are shown, since they
/// match the expected ones.
pub(super) fn passed(item: &Item, answers: &ReportAnswers) -> Markup {
    let questions = item.questions.iter().enumerate();
    let pictures = questions.filter_map(|(index, question)| {
        let answer = answers.answer(&item.id, index)?;
        picture::submitted_picture(question, answer)
    });
    html! {
        @for picture in pictures {
            div .panels {
                @for layer in &picture.layers {
                    (panel(picture.film, layer.name, &layer.pixels, "yours"))
                }
            }
        }
    }
}

/// Renders the submission's last rendered picture next to the reference's, or nothing if the exam
/// doesn't contain rendered pictures.
pub(super) fn beside_the_references(exam: &Exam, answers: &ReportAnswers) -> Markup {
    let mut pictures = exam.items.iter().rev().flat_map(|item| {
        let questions = item.questions.iter().enumerate();
        questions.filter_map(|(index, question)| {
            let is_light = matches!(question.question, Question::Radiance { .. });
            let answer = answers.answer(&item.id, index).filter(|_| is_light)?;
            picture::compare(question, answer)
        })
    });
    html! {
        @if let Some(picture) = pictures.next() {
            div .panels .trophy {
                @for layer in &picture.layers {
                    (panel(picture.film, layer.name, &layer.got, "drawn with your code"))
                    (panel(picture.film, layer.name, &layer.wanted, "drawn with the reference"))
                }
            }
        }
    }
}

/// A wrong picture, with its item and question.
struct WrongPicture<'a> {
    item: &'a Item,
    question: usize,
    picture: Picture,
    rerun: &'a RerunCommand,
    /// The submitted answer.
    answer: &'a Answer,
}

impl WrongPicture<'_> {
    fn render(&self) -> Markup {
        let picture = &self.picture;
        html! {
            div .picture data-columns=(picture.film.x) data-rows=(picture.film.y) {
                h4 { (self.title()) }
                div .overview {
                    (self.compare())
                    div { (self.mask()) (legend(picture)) }
                }
                (self.spots())
                h5 { "Side by side" }
                div .panels {
                    @for view in &picture.layers { (row(picture, view)) }
                }
            }
        }
    }

    fn title(&self) -> String {
        let pictures = self.item.questions.iter().enumerate();
        let mut pictures = pictures.filter(|(_, question)| picture::asks_for_picture(question));
        let index = pictures
            .clone()
            .position(|(question, _)| question == self.question);
        match (pictures.nth(1), index) {
            (Some(_), Some(index)) => format!("Picture {}", index + 1),
            (None, _) | (_, None) => "The picture".to_owned(),
        }
    }

    /// Renders the slider's view, which stays hidden without the script. It shows one layer at a
    /// time, with the submitted picture on top of the expected one.
    fn compare(&self) -> Markup {
        let group = format!("{}-{}-view", self.item.id, self.question);
        html! {
            div .compare hidden {
                @if self.picture.layers.len() > 1 {
                    fieldset {
                        legend { "Compare" }
                        @for (index, view) in self.picture.layers.iter().enumerate() {
                            label {
                                input type="radio" name=(group) value=(view.name) checked[index == 0];
                                " " (view.name)
                            }
                        }
                    }
                }
                div .frame .stage {
                    img .wanted alt="";
                    img .got alt="";
                }
                div .controls {
                    label .ends {
                        span { "expected" span .quiet { " to " } }
                        input type="range" min="0" max="100" value="50" step="1";
                        span { "yours" }
                    }
                    button type="button" .flicker aria-pressed="false" { "Flicker" }
                }
            }
        }
    }

    fn mask(&self) -> Markup {
        let picture = &self.picture;
        html! {
            figure {
                div .frame {
                    img src=(mask::mask(picture)) alt="the wrong pixels, as listed below";
                    svg .marks viewBox=(format!("0 0 {MARKS_WIDTH} {MARKS_WIDTH}")) role="group" aria-label="the worst pixels" {
                        @for (index, spot) in picture.worst_pixels.iter().enumerate() {
                            (mark(picture, spot, index + 1, &self.id(index)))
                        }
                    }
                }
                figcaption { "what is wrong" }
            }
        }
    }

    fn spots(&self) -> Markup {
        let question = &self.item.questions[self.question];
        html! {
            @if !self.picture.worst_pixels.is_empty() {
                h5 { "The worst pixels" }
                ol .spots {
                    @for (index, spot) in self.picture.worst_pixels.iter().enumerate() {
                        @let number = self.item.number(self.question, spot.element);
                        li {
                            details #(self.id(index)) .spot data-x=(spot.pixel.x) data-y=(spot.pixel.y) {
                                summary { (spot_label(spot)) }
                                (evidence_table(
                                    &describe::element(&question.question, spot.element),
                                    &describe::answer::got(self.answer, spot.element),
                                    &describe::answer::wanted(question, spot.element).join(", or "),
                                ))
                                p .rerun {
                                    "Run it again: "
                                    (command(&self.rerun.replay(&self.item.id, number)))
                                }
                            }
                        }
                    }
                }
            }
        }
    }

    fn id(&self, index: usize) -> String {
        format!("{}-{}-spot-{}", self.item.id, self.question, index + 1)
    }
}

fn spot_label(spot: &WorstPixel) -> String {
    let (x, y) = (spot.pixel.x, spot.pixel.y);
    format!("pixel ({x}, {y}): {}", spot.aspect.name())
}

/// Renders one layer of the expected picture, the submitted picture and their difference.
fn row(picture: &Picture, view: &LayerComparison) -> Markup {
    html! {
        div .row data-view=(view.name) {
            (panel(picture.film, view.name, &view.wanted, "expected"))
            (panel(picture.film, view.name, &view.got, "yours"))
            (panel(picture.film, view.name, &view.difference, "difference × 4"))
        }
    }
}

fn panel(film: UVec2, view: &str, pixels: &[picture::Colour], what: &str) -> Markup {
    let title = format!("{view}, {what}");
    html! {
        figure {
            div .frame { img src=(data_uri(film, pixels)) alt=(title); }
            figcaption { (title) }
        }
    }
}

/// Renders a numbered ring around a pixel of the mask, with a link to the pixel's details.
fn mark(picture: &Picture, spot: &WorstPixel, number: usize, id: &str) -> Markup {
    let position = (spot.pixel.as_vec2() + 0.5) / picture.film.as_vec2();
    // Keep the entire ring inside the mask. The pixel stays inside the ring.
    let inside = |along: f32| {
        (along * MARKS_WIDTH).clamp(MARK_RADIUS + 0.4, MARKS_WIDTH - MARK_RADIUS - 0.4)
    };
    let (across, down) = (inside(position.x), inside(1.0 - position.y));
    html! {
        a href=(format!("#{id}")) aria-label=(format!("{number}: {}", spot_label(spot))) {
            circle cx=(across) cy=(down) r=(MARK_RADIUS) {}
            text x=(across) y=(down) dy="0.35em" text-anchor="middle" aria-hidden="true" { (number) }
        }
    }
}

/// Renders the legend of the mask, with the number of wrong positions per pattern.
fn legend(picture: &Picture) -> Markup {
    html! {
        table .legend {
            caption {
                "Wrong positions, out of " (picture.positions)
                " in " (picture.film.x) " × " (picture.film.y) " pixels"
            }
            thead {
                tr { th scope="col" { "What" } th scope="col" .number { "Positions" } }
            }
            tbody {
                @for (aspect, count) in &picture.wrong_counts {
                    tr {
                        th scope="row" {
                            img src=(mask::patch(*aspect)) alt="" width="16" height="16"; " "
                            (plain_text(aspect.name()))
                        }
                        td .number { (count) }
                    }
                }
            }
        }
    }
}
