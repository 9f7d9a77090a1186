#!/usr/bin/env bash
# report_in_browser.sh TREAD run|sweep FILE [--set key=value ...]: runs the scene or the study and opens its report in a
# headless Chromium: no error of any script, every figure drawn, a run's movie not blank, no page that scrolls sideways,
# curves as CSV, at most 10 MB. With REPORT set that file is opened instead. Skipped (77) where there is no Chromium.
set -euo pipefail
tread=$1 command=$2 file=$3
shift 3
browser=""
for name in chromium chromium-browser google-chrome; do
  browser=$(command -v $name) && break
done
if [[ -z $browser ]]; then
  echo "NOT CHECKED: there is no Chromium on this machine (package chromium)"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
report=${REPORT:-$work/run/report.html}
[[ -n ${REPORT:-} ]] || OMP_WAIT_POLICY=passive "$tread" "$command" "$file" -t 1 --quiet -o "$work/run" "$@"

bytes=$(stat -c %s "$report")
((bytes <= 10000000)) || { echo "$report holds $bytes bytes, more than 10 MB"; exit 1; }

# The same page with a probe: faults are noted from the first script on, the rest is looked at when all has been drawn.
first='<script>window.faults=[];addEventListener("error",(e)=>faults.push(e.message));</script>'
cat >"$work/probe.html" <<'PROBE'
<script>
addEventListener("load", () => {
  const blank = (canvas) => !canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some((v) => v);
  const charts = [...document.querySelectorAll("figure.chart")];
  const rows = charts.map((figure) => figure.curvesAsCsv ? figure.curvesAsCsv((t) => t).trim().split("\n") : []);
  const broken = rows.flat().filter((row) => /NaN|undefined| × 10/.test(row));
  // Figures of a chapter over one abscissa zoom together, each as far as it goes, and go back together.
  const ticks = (chart) => [...chart.querySelectorAll(".xtick")].map((mark) => mark.textContent).join();
  const alike = charts.map((chart) => [...chart.closest("section").querySelectorAll("figure.chart")]
    .filter((other) => other.abscissa === chart.abscissa)).find((group) => group.length > 1) ?? [];
  if (alike.length > 0) {
    const [before, svg] = [alike.map(ticks), alike[0].querySelector(":scope > svg")];
    const box = svg.getBoundingClientRect();
    const at = (share) => ({clientX: box.left + share * box.width, pointerId: 1, bubbles: true});
    svg.setPointerCapture = () => {};
    svg.dispatchEvent(new PointerEvent("pointerdown", at(.4)));
    svg.dispatchEvent(new PointerEvent("pointerup", at(.5)));
    if (alike.some((chart, i) => ticks(chart) === before[i])) faults.push("figures do not zoom together");
    svg.dispatchEvent(new MouseEvent("dblclick"));
    if (alike.some((chart, i) => ticks(chart) !== before[i])) faults.push("figures do not go back together");
  }
  const movie = document.querySelector("figure.movie");
  if (movie) {
    const slider = movie.querySelector("input");
    slider.value = slider.max;
    slider.dispatchEvent(new Event("input"));
    if (movie.dataset.drawn !== slider.max) faults.push("the slider does not move the movie");
  }
  const page = document.documentElement;
  const list = [["faults", faults.join("; ") || "none"], ["charts", charts.length], ["zoom together", alike.length],
    ["live", document.querySelectorAll("figure.chart.live").length],
    ["curves without points", rows.filter((r) => r.length < 2).length], ["broken rows", broken.length],
    ["wider than the window by", page.scrollWidth - page.clientWidth], ["movies", document.querySelectorAll("figure.movie").length],
    ["canvases", document.querySelectorAll("canvas").length],
    ["blank", [...document.querySelectorAll("canvas")].filter(blank).length],
    ["tables", document.querySelectorAll("table").length], ["copied by", document.querySelectorAll("table button.copy").length],
    ["ready after ms", Math.round(performance.now())]];
  const shown = document.body.appendChild(document.createElement("pre"));
  shown.textContent = "\n" + list.map(([name, value]) => `probe ${name}: ${value}`).join("\n") + "\n";
});
</script>
PROBE
sed "s#<head>#<head>$first#" "$report" >"$work/probed.html"
cat "$work/probe.html" >>"$work/probed.html"
"$browser" --headless --no-sandbox --disable-gpu --virtual-time-budget=10000 --user-data-dir="$work/profile" \
  --dump-dom "file://$work/probed.html" >"$work/dom.html" 2>"$work/log" || { cat "$work/log"; exit 1; }
grep '^probe ' "$work/dom.html" || { echo "the page was not drawn"; cat "$work/log"; exit 1; }
echo "bytes: $bytes"

value() { sed -n "s/^probe $1: //p" "$work/dom.html"; }
failed=0
[[ $(value faults) == none ]] || { echo "FAILED: errors of scripts"; failed=1; }
(($(value charts) > 0 && $(value charts) == $(value live))) || { echo "FAILED: figures that were not drawn"; failed=1; }
(($(value "curves without points") == 0 && $(value "broken rows") == 0)) || { echo "FAILED: curves as CSV"; failed=1; }
(($(value canvases) == 2 * $(value movies) && $(value blank) == 0)) || { echo "FAILED: the movie is blank"; failed=1; }
[[ $command != run ]] || (($(value movies) == 1)) || { echo "FAILED: there is no movie"; failed=1; }
(($(value "wider than the window by") == 0)) || { echo "FAILED: the page scrolls sideways"; failed=1; }
(($(value tables) == $(value "copied by"))) || { echo "FAILED: tables that cannot be copied"; failed=1; }
exit $failed
