// A page that changes the player's style, and hears when its visitor does.
const player = document.querySelector("#figure");
const manner = document.querySelector("#manner");

for (const button of document.querySelectorAll("button[data-styles]"))
  button.addEventListener("click", () => {
    // The attribute, as in HTML; the property `styles` takes an object as well.
    player.setAttribute("styles", button.dataset.styles);
    manner.textContent = button.textContent;
  });

player.addEventListener("stylechange", ({ detail }) => {
  const [heaviest] = Object.entries(detail.styles).sort(([, a], [, b]) => b - a);
  manner.textContent = `mostly ${heaviest[0]}`;
});
