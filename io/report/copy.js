// Every curve as CSV, every table to the clipboard as a spreadsheet takes it.
{
const button = (text, title, act) => {
  const made = document.createElement("button");
  made.type = "button";
  made.className = "copy";
  made.textContent = text;
  made.title = title;
  made.addEventListener("click", act);
  return made;
};
const csv = (text) => /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
const save = (name, text) => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], {type: "text/csv"}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
};
const copy = (text) => {
  const area = document.body.appendChild(document.createElement("textarea"));
  area.value = text;
  area.select();
  document.execCommand("copy");  // the clipboard interface is closed to pages that are files
  area.remove();
};

for (const figure of document.querySelectorAll("figure.chart")) {
  const title = figure.querySelector("figcaption");
  const name = title.textContent.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_|_$/g, "");
  title.append(button("CSV", "Save the curves", () => save(`${name}.csv`, figure.curvesAsCsv(csv))));
}
for (const table of document.querySelectorAll("table")) {
  const text = () => [...table.rows].map((row) =>
      [...row.cells].map((cell) => cell.textContent.replaceAll("−", "-")).join("\t")).join("\n");
  const caption = table.caption ?? table.createCaption();
  caption.append(button("Copy", "Copy the table for a spreadsheet", () => copy(text())));
}
}
