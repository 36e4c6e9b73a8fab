'use strict';
// Makes the page interactive. The page can be read without this script.

const announce = (text) => { document.getElementById('status').textContent = text; };

// Links open the folded sections around their target.
const unfold = (element) => {
  for (let at = element; at; at = at.parentElement) {
    if (at.tagName === 'DETAILS') at.open = true;
  }
};
const showTarget = () => {
  const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
  if (!target) return;
  unfold(target);
  target.scrollIntoView();
};
addEventListener('hashchange', showTarget);
// A second click on the same link does not change the hash.
addEventListener('click', (event) => {
  const link = event.target.closest('a[href^="#"]');
  if (link && link.getAttribute('href') === location.hash) showTarget();
});
if (!history.state) showTarget();

// With `--watch`, the page reloads to show newer results, and open sections stay open. It does not
// reload while it has the focus, so that it never moves under the reader.
const before = history.state;
if (before) {
  for (const details of document.querySelectorAll('details[id]')) {
    // Sections that are new since the last load keep the page's default state.
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
      announce('Copied');
      button.textContent = 'Copied';
      setTimeout(() => { button.textContent = 'Copy'; }, 2000);
    } catch {
      // Without access to the clipboard, select the text.
      getSelection().selectAllChildren(code);
      announce('Selected: copy it with the keyboard');
    }
  });
}

// Opens everything for printing.
const folded = [];
addEventListener('beforeprint', () => {
  folded.push(...document.querySelectorAll('details:not([open])'));
  for (const details of folded) details.open = true;
});
addEventListener('afterprint', () => {
  for (const details of folded.splice(0)) details.open = false;
});

const calm = matchMedia('(prefers-reduced-motion: reduce)');
// Two pictures per second, well below the three flashes per second that WCAG allows.
const FLICKER_MS = 500;

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
    slider.setAttribute('aria-valuetext', `${slider.value}% yours`);
  };
  const swap = () => { slider.value = Number(slider.value) < 50 ? 100 : 0; slide(); };
  const stop = () => {
    clearInterval(flicker.timer);
    flicker.setAttribute('aria-pressed', 'false');
  };
  flicker.addEventListener('click', () => {
    if (flicker.getAttribute('aria-pressed') === 'true') return stop();
    swap();
    // With reduced motion, each click swaps once.
    if (calm.matches) return;
    flicker.setAttribute('aria-pressed', 'true');
    flicker.timer = setInterval(swap, FLICKER_MS);
  });
  const name = () => { flicker.textContent = calm.matches ? 'Swap' : 'Flicker'; stop(); };
  calm.addEventListener('change', name);
  name();
  slider.addEventListener('input', () => { stop(); slide(); });
  for (const radio of compare.querySelectorAll('input[type=radio]')) {
    radio.addEventListener('change', () => show(radio.value));
  }
  // Browsers restore the chosen radio button when they reload a page.
  show(compare.querySelector('input[type=radio]:checked')?.value ?? rows[0].dataset.view);
  slide();
  compare.hidden = false;

  // A ring marks each open spot in every picture.
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
