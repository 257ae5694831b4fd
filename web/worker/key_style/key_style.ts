/**
 * Poses of style variables for the page. It needs no worker: a pose takes microseconds, and what a hand drags is to be seen
 * in the same frame. Training, which takes longer, is `BuildClient.trainKeyStyle`.
 */
export * from "../../engine/key_style/model";
