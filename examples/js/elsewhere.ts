// Files of the package that lie elsewhere, docs/embedding.md: `npm test` checks the types.
import { loadStrut } from "strut-motion";

// anchor assets
const strut = await loadStrut({ assets: "/files" });
// end assets

console.log(strut.thread);
