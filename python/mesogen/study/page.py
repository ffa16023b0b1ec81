"""The report as one HTML page that opens from disk, without a server or anything from the network."""

import html
import json

from .section import Animation, Picture
from .verdict import DOES_NOT_HOLD, HOLDS, NOT_RESOLVED

MARKS = {HOLDS: "holds", DOES_NOT_HOLD: "fails", NOT_RESOLVED: "open"}

STYLE = """
:root { --ink: #22262b; --quiet: #6b747e; --line: #dfe3e7; --holds: #2f7d55; --fails: #c4452b; --open: #8a6d1f; }
* { box-sizing: border-box; }
body { margin: 0; color: var(--ink); font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; background: #fff; }
main { max-width: 62rem; margin: 0 auto; padding: 2.5rem 1.5rem 5rem; }
h1 { font-size: 1.9rem; line-height: 1.2; margin: 0 0 .4rem; }
h2 { font-size: 1.35rem; margin: 3.2rem 0 .2rem; padding-top: 1rem; border-top: 1px solid var(--line); }
.quiet { color: var(--quiet); font-size: .92rem; margin: 0 0 1rem; }
figure { margin: 1.2rem 0; }
figure img { max-width: 100%; height: auto; display: block; }
figcaption { color: var(--quiet); font-size: .9rem; margin-top: .35rem; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .92rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; vertical-align: top; padding: .35rem .9rem .35rem 0; border-bottom: 1px solid var(--line); }
th { font-weight: 600; }
.verdict { font-weight: 600; white-space: nowrap; }
.holds { color: var(--holds); } .fails { color: var(--fails); } .open { color: var(--open); }
.claim { border-left: 4px solid var(--line); padding: .1rem 0 .1rem .9rem; margin: .9rem 0; }
.claim.holds { border-color: var(--holds); } .claim.fails { border-color: var(--fails); } .claim.open { border-color: var(--open); }
.claim p { margin: .1rem 0; color: var(--ink); }
.claim .remark { color: var(--quiet); font-size: .92rem; }
.player { display: flex; align-items: center; gap: .8rem; margin-top: .4rem; max-width: 34rem; }
.player input { flex: 1; } .player button { min-width: 4.5rem; font: inherit; }
.player output { min-width: 6rem; color: var(--quiet); }
pre { background: #f5f6f7; padding: 1rem; overflow-x: auto; font-size: .82rem; line-height: 1.4; }
details { margin: .6rem 0; } summary { cursor: pointer; }
a { color: #2a5c8a; }
"""

PLAYER = """
for (const player of document.querySelectorAll(".player")) {
  const frames = JSON.parse(player.dataset.frames), labels = JSON.parse(player.dataset.labels);
  const image = player.parentElement.querySelector("img");
  const [button, slider, label] = ["button", "input", "output"].map(name => player.querySelector(name));
  let timer = null;
  const loaded = frames.map(() => null);
  const load = n => loaded[n] || (loaded[n] = Object.assign(new Image(), {src: frames[n]}));
  const show = n => { slider.value = n; image.src = load(n).src; label.textContent = labels[n]; load((n + 1) % frames.length); };
  const stop = () => { clearInterval(timer); timer = null; button.textContent = "play"; };
  button.onclick = () => {
    if (timer) return stop();
    button.textContent = "stop";
    timer = setInterval(() => show((+slider.value + 1) % frames.length), 120);
  };
  slider.oninput = () => { stop(); show(+slider.value); };
}
"""


def page(study, sections, provenance, problems=()):
    """The text of the page. sections: filled Sections. provenance: [(name, text)], texts of several lines are folded.
    problems: texts about what is missing."""
    claims = [(section, claim) for section in sections for claim in section.claims]
    body = [f"<h1>{_text(study.title)}</h1>", f'<p class="quiet">{_text(study.source)}</p>', _summary(claims)]
    body += [f'<p class="fails">Missing: {_text(problem)}.</p>' for problem in problems]
    for section in sections:
        body.append(f'<h2 id="{section.name}">{_text(section.title)}</h2>')
        if section.figure_of_paper:
            body.append(f'<p class="quiet">In the paper: {_text(section.figure_of_paper)}.</p>')
        body += [_claim(claim) for claim in section.claims]
        body += [_part(part) for part in section.parts]
    body.append('<h2 id="provenance">How this was made</h2>')
    for what, text in provenance:
        if "\n" in text:
            body.append(f"<details><summary>{_text(what)}</summary><pre>{_text(text)}</pre></details>")
        else:
            body.append(f"<p><b>{_text(what)}</b> {_text(text)}</p>")
    return ("<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
            "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">"
            f"<title>{_text(study.title)}</title><style>{STYLE}</style></head>\n<body><main>\n" + "\n".join(body)
            + f"\n</main><script>{PLAYER}</script></body></html>\n")


def _summary(claims):
    counts = ", ".join(f'<span class="{mark}">{_counted(claims, verdict)}</span>' for verdict, mark in MARKS.items())
    rows = "".join(f'<tr><td>{_text(claim.text)}</td><td class="verdict {MARKS[claim.verdict]}"><a class="{MARKS[claim.verdict]}" '
                   f'href="#{section.name}">{claim.verdict}</a></td></tr>' for section, claim in claims)
    return f"<p>{len(claims)} claim{'s' if len(claims) != 1 else ''}: {counts}.</p>\n<table><tr><th>Claim</th><th>Verdict</th></tr>{rows}</table>"


def _counted(claims, verdict):
    count = sum(claim.verdict == verdict for _, claim in claims)
    if count == 1 or verdict == NOT_RESOLVED:
        return f"{count} {verdict}"
    return f"{count} {'hold' if verdict == HOLDS else 'do not hold'}"


def _claim(claim):
    remark = f'<p class="remark">{_text(claim.remark)}</p>' if claim.remark else ""
    mark = MARKS[claim.verdict]
    return (f'<div class="claim {mark}"><p>{_text(claim.text)} <span class="verdict {mark}">{claim.verdict}</span></p>'
            f'<p class="remark">{_text(claim.numbers)}</p>{remark}</div>')


def _part(part):
    if isinstance(part, Picture):
        data = f' <a href="{part.data}">Numbers</a>' if part.data else ""
        return (f'<figure><img src="{part.file}" alt="{_text(part.caption)}" loading="lazy">'
                f"<figcaption>{_text(part.caption)}{data}</figcaption></figure>")
    if isinstance(part, Animation):
        last = len(part.frames) - 1
        return (f'<figure><img src="{part.frames[-1]}" alt="{_text(part.caption)}">'
                f'<div class="player" data-frames="{_text(json.dumps(part.frames))}" data-labels="{_text(json.dumps(part.labels))}">'
                f'<button>play</button><input type="range" min="0" max="{last}" value="{last}" aria-label="frame">'
                f"<output>{_text(part.labels[-1])}</output></div><figcaption>{_text(part.caption)}</figcaption></figure>")
    if isinstance(part, tuple):
        columns, rows = part
        head = "".join(f"<th>{_text(name)}</th>" for name in columns)
        lines = "".join("<tr>" + "".join(f"<td>{_text(cell)}</td>" for cell in row) + "</tr>" for row in rows)
        return f"<table><tr>{head}</tr>{lines}</table>"
    return f"<p>{_text(part)}</p>"


def _text(words):
    return html.escape(str(words))
