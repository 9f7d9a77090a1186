#!/usr/bin/env python3
"""Takes one figure out of a report.html as a stand-alone SVG: report_figure.py REPORT NUMBER OUT (numbers from 0).

docs/records/corrugation-d.svg is figure 0 of the draft run of scenes/corrugation-d.toml.
"""
import re
import sys

if len(sys.argv) != 4:
    sys.exit(__doc__)
report, number, out = sys.argv[1], int(sys.argv[2]), sys.argv[3]
text = open(report, encoding="utf-8").read()
figures = re.findall(r"<figure.*?</figure>", text, re.S)
if not 0 <= number < len(figures):
    sys.exit(f"{report} has {len(figures)} figures; {number} is not one of them")
start = figures[number].index('<svg viewBox="0 0 9')
drawing = figures[number][start : figures[number].rindex("</svg>") + len("</svg>")]
style = re.search(r"<style>(.*?)</style>", text, re.S).group(1)
head = '<svg xmlns="http://www.w3.org/2000/svg"' + drawing[len("<svg") : drawing.index(">") + 1]
background = '<rect width="100%" height="100%" fill="white"/>'
with open(out, "w", encoding="utf-8") as file:
    file.write(head + "<style>" + style + "</style>" + background + drawing[drawing.index(">") + 1 :])
