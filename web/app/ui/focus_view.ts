/** Moves the focus to the heading of a view, or to the view itself, without scrolling. */
export function focusView(view: Element): void {
  const heading = view.querySelector<HTMLElement>("h1") ?? (view as HTMLElement);
  heading.tabIndex = -1;
  heading.focus({ preventScroll: true });
}
