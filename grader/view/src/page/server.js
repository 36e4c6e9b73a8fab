// Talks to the viewer: sends commands, and waits for updates.

const refused = document.getElementById("refused");
const token = takeToken();

/** Moves the secret from the address to this origin's storage, which other ports cannot read. */
function takeToken() {
  const given = new URLSearchParams(location.search).get("token");
  try {
    if (given === null) return localStorage.getItem("token") ?? "";
    localStorage.setItem("token", given);
    history.replaceState(null, "", "/");
  } catch {
    // The browser forbids storage, so the secret stays in the address.
  }
  return given ?? "";
}

/** Sends a request with the secret. */
export async function request(path, options) {
  return fetch(path, { ...options, headers: { "View-Token": token } });
}

/** Sends a command, such as { view: "depth" }. If it is refused, the page shows why. */
export async function send(command) {
  // If the viewer has ended, the request for updates fails too, and the page says so.
  const answer = await request("/command", { method: "POST", body: JSON.stringify(command) }).catch(() => null);
  refused.textContent = answer && !answer.ok ? await answer.text() : "";
}

/** Returns some data, or null if there is none. */
export async function load(path) {
  const answer = await request(path).catch(() => null);
  return answer?.ok ? answer.json() : null;
}

/** Calls `show` with each new state, and `connected` with whether the viewer answers. */
export async function follow(show, connected) {
  let version = 0;
  for (;;) {
    // A hidden tab waits, so that ten tabs don't need ten connections.
    if (document.hidden) {
      await new Promise((seen) => document.addEventListener("visibilitychange", seen, { once: true }));
      continue;
    }
    try {
      const answer = await request(`/state?after=${version}`);
      connected(answer.ok);
      if (answer.status === 200) {
        const state = await answer.json();
        version = state.version;
        show(state);
      } else if (!answer.ok) {
        if (answer.status === 403) refused.textContent = await answer.text();
        await pause(2000);
      }
    } catch {
      connected(false);
      await pause(1000);
    }
  }
}

function pause(milliseconds) {
  return new Promise((done) => setTimeout(done, milliseconds));
}

const movements = [];
let isMoving = false;

/** Moves the camera, one request at a time. Waiting movements of the same kind are combined. */
export async function move(kind, amounts) {
  const last = movements.at(-1);
  if (last?.kind === kind) {
    last.amounts = last.amounts.map((amount, i) =>
      kind === "dolly" ? amount * amounts[i] : amount + amounts[i]);
  } else {
    movements.push({ kind, amounts: [...amounts] });
  }
  if (isMoving) return;
  isMoving = true;
  while (movements.length > 0) {
    const { kind, amounts } = movements.shift();
    await send({ move: { [kind]: amounts.length === 1 ? amounts[0] : amounts } });
  }
  isMoving = false;
}
