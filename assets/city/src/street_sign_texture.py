#!/usr/bin/env python3
"""Draws assets/city/street_sign.png: the enamel of the street sign.

Needs Pillow and the font Roadgeek 2014 (MIT licence; Debian: apt install fonts-roadgeek).
The picture covers the plate's face and, unfolded around it, its rim: see street_sign_model.py.
"""
from pathlib import Path

from PIL import Image, ImageDraw, ImageFont

FONTS = Path("/usr/share/fonts/truetype/roadgeek")
# Metres. The margin is the rim and the return behind it, unfolded.
WIDTH, HEIGHT, CORNER, MARGIN = 1.30, 0.78, 0.07, 0.04
PIXELS_PER_METRE = 2048 / (WIDTH + 2 * MARGIN)
OVERSAMPLING = 3

BLUE = (12, 84, 168)
WHITE = (240, 240, 232)
YELLOW = (250, 190, 20)
BLACK = (24, 24, 26)


def main() -> None:
    scale = PIXELS_PER_METRE * OVERSAMPLING
    size = (round((WIDTH + 2 * MARGIN) * scale), round((HEIGHT + 2 * MARGIN) * scale))
    image = Image.new("RGB", size, BLUE)
    draw = ImageDraw.Draw(image)

    def px(x: float, y: float) -> tuple[float, float]:
        """Plate coordinates, metres from the centre, y up."""
        return ((x + WIDTH / 2 + MARGIN) * scale, (HEIGHT / 2 + MARGIN - y) * scale)

    def rounded(inset: float, colour) -> None:
        left_top = px(-WIDTH / 2 + inset, HEIGHT / 2 - inset)
        right_bottom = px(WIDTH / 2 - inset, -HEIGHT / 2 + inset)
        draw.rounded_rectangle((*left_top, *right_bottom), radius=(CORNER - inset) * scale, fill=colour)

    def text(string: str, x: float, y: float, cap: float, series: str, colour, anchor: str) -> None:
        """`cap` is the height of the capitals, `y` that of the base line."""
        # Find the size that gives the capital H its height: metrics differ between font formats.
        probe = ImageFont.truetype(FONTS / f"RG2014{series}.ttf", 1000)
        top, bottom = probe.getbbox("H", anchor="ls")[1::2]
        font = ImageFont.truetype(FONTS / f"RG2014{series}.ttf", round(1000 * cap * scale / (bottom - top)))
        draw.text(px(x, y), string, font=font, fill=colour, anchor=anchor)

    # White border, set in from the edge.
    rounded(0.014, WHITE)
    rounded(0.031, BLUE)

    # Destinations and their distances.
    for string, distance, base in (("Tarnis", "12", 0.110), ("Eastgate", "3", -0.125)):
        text(string, -0.315, base, 0.138, "D", WHITE, "ls")
        text(distance, 0.560, base, 0.138, "D", WHITE, "rs")
    text("HARBOUR ROAD", -0.311, -0.300, 0.062, "D", WHITE, "ls")

    # Route marker.
    left, top, right, bottom = -0.565, 0.285, -0.375, 0.085
    for inset, colour in ((0.0, WHITE), (0.009, BLACK), (0.016, YELLOW)):
        draw.rounded_rectangle(
            (*px(left + inset, top - inset), *px(right - inset, bottom + inset)),
            radius=(0.035 - inset) * scale,
            fill=colour,
        )
    text("17", (left + right) / 2, 0.130, 0.112, "D", BLACK, "ms")

    # Arrow: straight on.
    x, tip, foot = (left + right) / 2, 0.025, -0.305
    outline = [(0, 0), (0.090, -0.105), (0.090, -0.150), (0.023, -0.078), (0.023, foot - tip)]
    points = [(x + dx, tip + dy) for dx, dy in outline]
    points += [(x - dx, tip + dy) for dx, dy in reversed(outline)]
    draw.polygon([px(*p) for p in points], fill=WHITE)

    image = image.resize((size[0] // OVERSAMPLING, size[1] // OVERSAMPLING), Image.Resampling.LANCZOS)
    image = image.quantize(128, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE)
    target = Path(__file__).parent.parent / "street_sign.png"
    image.save(target, optimize=True)
    print(target.name, image.size, target.stat().st_size, "bytes")


main()
