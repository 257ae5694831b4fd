// The scene: a floor without end, daylight, and a camera that walks beside the figure. Nothing here is Strut's.
import * as THREE from "three";

const PAPER = "#efe9df";
/** Where the camera and the light are, seen from the figure. */
const CAMERA = new THREE.Vector3(3.4, 1.35, 4.5);
const LIGHT = new THREE.Vector3(2.2, 4, 1.2);

export class Studio {
  constructor(canvas) {
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.toneMapping = THREE.NeutralToneMapping;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.camera = new THREE.PerspectiveCamera(26, 1, 0.1, 50);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(PAPER);
    this.scene.fog = new THREE.Fog(PAPER, 6, 14);
    this.scene.add(new THREE.HemisphereLight("#fffaf2", "#e6d6c0", 2));
    this.light = new THREE.DirectionalLight("#fff4e4", 2.2);
    this.light.castShadow = true;
    this.light.shadow.mapSize.setScalar(2048);
    this.light.shadow.radius = 5;
    Object.assign(this.light.shadow.camera, { left: -2, right: 2, top: 2, bottom: -2, near: 1, far: 8 });
    this.floor = floor();
    this.scene.add(this.light, this.light.target, this.floor);
    this.place = new THREE.Vector3();
    const fit = () => {
      this.renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
      this.camera.aspect = canvas.clientWidth / canvas.clientHeight;
      this.camera.updateProjectionMatrix();
    };
    new ResizeObserver(fit).observe(canvas);
    fit();
  }

  /**
   * Draws the scene around a place.
   * @param cut whether the figure has jumped there, as at the end of a loop
   */
  draw({ x, z }, dtSecs, cut) {
    const aim = new THREE.Vector3(x, 0, z);
    // The camera lags a little, so that the figure's own sway is seen.
    this.place.lerp(aim, cut ? 1 : 1 - Math.exp(-6 * dtSecs));
    this.camera.position.copy(this.place).add(CAMERA);
    this.camera.lookAt(this.place.x, 0.66, this.place.z);
    this.light.target.position.copy(this.place);
    this.light.position.copy(this.place).add(LIGHT);
    // The lines repeat, so the floor may follow in whole metres.
    this.floor.position.set(Math.round(x), 0, Math.round(z));
    this.renderer.render(this.scene, this.camera);
  }
}

/** Nothing but shadows, and fine lines every metre, which fade into the distance. */
function floor() {
  const plane = new THREE.Mesh(
    new THREE.PlaneGeometry(40, 40).rotateX(-Math.PI / 2),
    new THREE.ShadowMaterial({ color: "#3a2a18", opacity: 0.32 }),
  );
  plane.receiveShadow = true;
  const lines = new THREE.GridHelper(40, 40, "#cfc4b2", "#cfc4b2");
  lines.material.toneMapped = false;
  const group = new THREE.Group();
  group.add(plane, lines);
  return group;
}
