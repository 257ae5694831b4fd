/** Opens the Embed dialog for the displayed state. */
import { ENGINE_FIELDS } from "../../link/play";
import { DRIVE, type InputLibrary } from "../../player/input_library";
import { linkTo } from "../shell/links";
import { type AppState, initialState } from "../state/state";
import { strings } from "../strings/strings";
import { manner } from "../ui/words";

/** Fields of the state that an embedded figure has, too. */
const SHOWN = [...ENGINE_FIELDS, "camera", "speed", "loop"] as const satisfies readonly (keyof AppState)[];

/** The embedded state. */
interface EmbedSubject {
  state: Readonly<AppState>;
  library: InputLibrary;
  neutral: string;
  /** Whether the database exists only on this device. */
  hasOwnDatabase: boolean;
  /** Whether a rigged character is in use. */
  hasCharacter: boolean;
  onPoster: () => void;
  /** Called when the dialog is closed. */
  onClose: () => void;
}

/** Opens the dialog, which is loaded on first use. */
export async function embed({
  state,
  library,
  neutral,
  hasOwnDatabase,
  hasCharacter,
  onPoster,
  onClose,
}: EmbedSubject): Promise<void> {
  const shown = Object.fromEntries(SHOWN.map((name) => [name, state[name]]));
  // An embedded figure cannot be driven.
  const isFirst = state.input === library.first || state.input === DRIVE;
  const reduced: AppState = { ...initialState(), ...shown, input: isFirst ? "" : state.input };
  const site = new URL(".", location.href).href;
  const [{ href, carried }, { openEmbedDialog }] = await Promise.all([
    linkTo(reduced, library, site),
    import("./embed_dialog"),
  ]);
  openEmbedDialog({
    embedded: {
      site,
      state: new URL(href).hash.slice(1),
      title: strings.embed.title(manner(state.styles, state.intensity, neutral)),
    },
    link: href,
    ghost: state.ghost,
    notes: [
      ...(carried === false ? [strings.embed.motionLeftOut] : []),
      ...(hasOwnDatabase ? [strings.embed.databaseLeftOut] : []),
      ...(hasCharacter ? [strings.embed.characterLeftOut] : []),
    ],
    onPoster,
    onClose,
  });
}
