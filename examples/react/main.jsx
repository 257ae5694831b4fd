// The element in React 19, which sets its properties and hears its events: no wrapper is needed.
import { useState } from "react";
import { createRoot } from "react-dom/client";
import "strut-motion/element";

const MANNERS = { proud: { proud: 1 }, old: { old: 1 }, "half of each": { proud: 0.5, old: 0.5 } };

function Walk() {
  const [styles, setStyles] = useState(MANNERS.proud);
  const said = Object.entries(styles)
    .filter(([, weight]) => weight > 0.005)
    .map(([name, weight]) => `${name} ${weight.toFixed(2)}`)
    .join(", ");
  return (
    <main style={{ maxWidth: 688, margin: "2rem auto", fontFamily: "system-ui, sans-serif" }}>
      <h1>A walk in React</h1>
      <strut-player controls autoplay styles={styles} onstylechange={({ detail }) => setStyles(detail.styles)} />
      <p>
        {Object.entries(MANNERS).map(([name, manner]) => (
          <button type="button" key={name} onClick={() => setStyles(manner)}>
            {name}
          </button>
        ))}
      </p>
      <output>{said}</output>
    </main>
  );
}

createRoot(document.getElementById("root")).render(<Walk />);
