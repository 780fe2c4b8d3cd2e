// Colours of curves: apart for the colour-blind for up to seven (M. Okabe and K. Ito, 2008), an even
// walk through a scale for more, where neighbours are alike and order can be seen.

const fewColours = {
  light: ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#8a6d00", "#56b4e9", "#444444"],
  dark: ["#56b4e9", "#ff8c42", "#2fd0a0", "#e79bc8", "#f0e442", "#7fa8ff", "#cccccc"],
};
// viridis, without its ends, which vanish on black and on white.
const scale = [[68, 40, 120], [59, 82, 139], [44, 114, 142], [33, 145, 140], [40, 174, 128],
  [94, 201, 98], [173, 200, 40]];

function isDark() {
  return matchMedia("(prefers-color-scheme: dark)").matches;
}

function colourOf(place, of) {
  const few = fewColours[isDark() ? "dark" : "light"];
  if (of <= few.length) return few[place];
  const position = place / (of - 1) * (scale.length - 1);
  const low = Math.min(Math.floor(position), scale.length - 2), part = position - low;
  const lift = isDark() ? 0.25 : 0;
  const mix = scale[low].map((value, k) => {
    const colour = value + part * (scale[low + 1][k] - value);
    return Math.round(colour + lift * (255 - colour));
  });
  return `rgb(${mix.join(",")})`;
}

function cssColour(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(name).trim();
}
