'use strict';
// Brings to life what stands on the page already. Nothing here is needed to read it.

const say = (text) => { document.getElementById('said').textContent = text; };

// A link to something folded unfolds it.
const unfold = (element) => {
  for (let at = element; at; at = at.parentElement) {
    if (at.tagName === 'DETAILS') at.open = true;
  }
};
const toTarget = () => {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  unfold(target);
  target.scrollIntoView();
};
addEventListener('hashchange', toTarget);
// A second click on the same link changes no hash.
addEventListener('click', (event) => {
  const link = event.target.closest('a[href^="#"]');
  if (link && link.getAttribute('href') === location.hash) toTarget();
});
if (!history.state) toTarget();

// While files are watched, a newer page takes this one's place, and looks the same: what is
// unfolded stays so. Not while somebody is at it.
const before = history.state;
if (before) {
  for (const details of document.querySelectorAll('details[id]')) {
    // What was not there before is shown as a new page shows it.
    if (before.all.includes(details.id)) details.open = before.open.includes(details.id);
  }
}
if ('reload' in document.body.dataset) {
  setInterval(() => {
    if (document.hasFocus()) return;
    const ids = (which) => [...document.querySelectorAll(which)].map((details) => details.id);
    history.replaceState({ all: ids('details[id]'), open: ids('details[id][open]') }, '');
    location.reload();
  }, 1500);
}

for (const button of document.querySelectorAll('.copy')) {
  const code = button.previousElementSibling;
  button.hidden = false;
  button.addEventListener('click', async () => {
    try {
      await navigator.clipboard.writeText(code.textContent);
      say('Copied');
      button.textContent = 'Copied';
      setTimeout(() => { button.textContent = 'Copy'; }, 2000);
    } catch {
      // Where a page may not write there, it can still select.
      getSelection().selectAllChildren(code);
      say('Selected: copy it with the keyboard');
    }
  });
}

// On paper nothing can be unfolded.
const folded = [];
addEventListener('beforeprint', () => {
  folded.push(...document.querySelectorAll('details:not([open])'));
  for (const details of folded) details.open = true;
});
addEventListener('afterprint', () => {
  for (const details of folded.splice(0)) details.open = false;
});

const calm = matchMedia('(prefers-reduced-motion: reduce)');
// Two pictures a second: far from what can harm.
const PACE = 500;

for (const picture of document.querySelectorAll('.picture')) {
  const compare = picture.querySelector('.compare');
  const rows = [...picture.querySelectorAll('.row')];
  const stage = compare.querySelector('.stage');
  const [wanted, got] = stage.querySelectorAll('img');
  const slider = compare.querySelector('input[type=range]');
  const flicker = compare.querySelector('.flicker');

  const show = (view) => {
    for (const row of rows) row.hidden = row.dataset.view !== view;
    const [right, yours] = picture.querySelectorAll(`.row[data-view="${view}"] img`);
    [wanted.src, wanted.alt, got.src, got.alt] = [right.src, right.alt, yours.src, yours.alt];
  };
  const slide = () => {
    got.style.clipPath = `inset(0 ${100 - slider.value}% 0 0)`;
    slider.setAttribute('aria-valuetext', `${slider.value} % yours`);
  };
  const swap = () => { slider.value = Number(slider.value) < 50 ? 100 : 0; slide(); };
  const stop = () => {
    clearInterval(flicker.timer);
    flicker.setAttribute('aria-pressed', 'false');
  };
  flicker.addEventListener('click', () => {
    if (flicker.getAttribute('aria-pressed') === 'true') return stop();
    swap();
    // Who wants no motion swaps by hand.
    if (calm.matches) return;
    flicker.setAttribute('aria-pressed', 'true');
    flicker.timer = setInterval(swap, PACE);
  });
  const name = () => { flicker.textContent = calm.matches ? 'Swap' : 'Flicker'; stop(); };
  calm.addEventListener('change', name);
  name();
  slider.addEventListener('input', () => { stop(); slide(); });
  for (const radio of compare.querySelectorAll('input[type=radio]')) {
    radio.addEventListener('change', () => show(radio.value));
  }
  // A browser that reloads a page keeps what was chosen on it.
  show(compare.querySelector('input[type=radio]:checked')?.value ?? rows[0].dataset.view);
  slide();
  compare.hidden = false;

  // The spot that is unfolded is marked in every picture of the film.
  const spots = [...picture.querySelectorAll('.spot')];
  const mark = () => {
    for (const ring of picture.querySelectorAll('.ring')) ring.remove();
    for (const spot of spots.filter((spot) => spot.open)) {
      for (const frame of picture.querySelectorAll('.frame')) {
        const ring = document.createElement('span');
        ring.className = 'ring';
        ring.style.left = `${100 * (Number(spot.dataset.x) + 0.5) / picture.dataset.columns}%`;
        ring.style.bottom = `${100 * (Number(spot.dataset.y) + 0.5) / picture.dataset.rows}%`;
        frame.append(ring);
      }
    }
  };
  for (const spot of spots) spot.addEventListener('toggle', mark);
}
