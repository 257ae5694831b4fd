/** Figures of feet in German. */
import type { Words } from "../words";

export const feet: Words["feet"] = {
  title: "Wann ein Fuß steht und wie er rutscht",
  soles: "Die Sohle von oben",
  leg: "Ein Bein von der Seite",
  foot: "Fuß",
  sides: { left: "linker Fuß", right: "rechter Fuß" },
  hold: "Stehende Füße halten",
  ankle: "Knöchel",
  time: "Zeit, s",
  speed: "Rutschen, cm/s",
  likelihood: "P",
  across: "nach links, cm",
  along: "vorwärts, cm",
  forwards: "vorwärts, m",
  upwards: "von der Hüfte, m",
  read: (speed, likelihood) => `Rutschen ${speed} cm/s · P ${likelihood}`,
  slid: (cm) => `${cm} cm in diesem Stand`,
  reached: (d, gamma) => `d ${d} m · γ ${gamma}°`,
  said: (time, foot, stands, speed, held) =>
    `Bei ${time} s ${stands ? "steht" : "schwingt"} der ${foot.replace("linker", "linke").replace("rechter", "rechte")} und bewegt sich mit ${speed} cm/s, ${held ? "gehalten" : "nicht gehalten"}.`,
  seen: (foot, cm, held) => `Im Stand, ${held ? "gehalten" : "nicht gehalten"}, rutscht er um ${cm} cm: ${foot}.`,
  bent: (d, gamma, bend) =>
    `Der Knöchel ist ${d} m von der Hüfte: Der Winkel γ ist ${gamma}°, also ist das Knie um ${bend}° gebeugt.`,
  columns: ["Zeit, s", "Rutschen, cm/s", "P"],
  places: ["Zeit, s", "vorwärts, cm", "nach links, cm"],
  parts: ["Teil", "Wert"],
  rows: { a: "Oberschenkel a, m", b: "Unterschenkel b, m", d: "Hüfte bis Knöchel d, m", gamma: "Winkel γ, °" },
};
