/**
 * Walk synthesis for the page. It needs no worker: a frame takes microseconds, and what a hand changes is to be seen in the
 * next one. Training, which takes seconds, is `BuildClient.trainWalk`.
 */
export * from "../../engine/walk/walker";
