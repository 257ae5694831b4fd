// A figure of our own: one three.js node for each joint, and a piece of wood on each.
import * as THREE from "three";

// A pose of Strut is 87 numbers: the place of the hips (x y z, metres), then a quaternion (x y z w) for each of these 21
// joints, in this order, relative to its parent. In the T-pose all quaternions are 0 0 0 1; +Y is up, +Z is ahead.
const JOINTS = [
  ["hips", null],
  ["spine", "hips"],
  ["chest", "spine"],
  ["neck", "chest"],
  ["head", "neck"],
  ["left_shoulder", "chest"],
  ["left_upper_arm", "left_shoulder"],
  ["left_lower_arm", "left_upper_arm"],
  ["left_hand", "left_lower_arm"],
  ["right_shoulder", "chest"],
  ["right_upper_arm", "right_shoulder"],
  ["right_lower_arm", "right_upper_arm"],
  ["right_hand", "right_lower_arm"],
  ["left_upper_leg", "hips"],
  ["left_lower_leg", "left_upper_leg"],
  ["left_foot", "left_lower_leg"],
  ["left_toes", "left_foot"],
  ["right_upper_leg", "hips"],
  ["right_lower_leg", "right_upper_leg"],
  ["right_foot", "right_lower_leg"],
  ["right_toes", "right_foot"],
];

const WOOD = new THREE.MeshPhysicalMaterial({
  color: "#d3a878",
  roughness: 0.5,
  clearcoat: 0.3,
  clearcoatRoughness: 0.4,
});
const DARK = new THREE.MeshPhysicalMaterial({
  color: "#6b4a33",
  roughness: 0.45,
  clearcoat: 0.3,
  clearcoatRoughness: 0.4,
});
const ACCENT = new THREE.Color("#b5381a");

export class Figure {
  /** @param proportions `database.info.proportions`: where each joint lies in its parent, 21 × x y z, metres */
  constructor(proportions) {
    this.joints = {};
    for (const [index, [name, parent]] of JOINTS.entries()) {
      const joint = new THREE.Group();
      joint.name = name;
      joint.position.fromArray(proportions, 3 * index);
      if (parent) this.joints[parent].add(joint);
      this.joints[name] = joint;
    }
    this.carve();
    this.root = this.joints.hips;
    this.root.traverse((object) => {
      object.castShadow = object.isMesh;
    });
  }

  /** Takes a pose. This is all that it takes to move a figure. */
  pose(pose) {
    this.root.position.fromArray(pose, 0);
    for (const [index, [name]] of JOINTS.entries()) this.joints[name].quaternion.fromArray(pose, 3 + 4 * index);
  }

  /** Colours the soles that the engine holds on the floor. */
  plant([left, right]) {
    this.soles[0].material.emissive.copy(ACCENT).multiplyScalar(left ? 1 : 0);
    this.soles[1].material.emissive.copy(ACCENT).multiplyScalar(right ? 1 : 0);
  }

  /** Turns the wood: spindles along the bones, balls at the joints. */
  carve() {
    const { joints } = this;
    this.block("hips", [0.13, 0.075, 0.085], [0, -0.01, 0]);
    this.spindle("hips", joints.spine.position.toArray(), 0.062, DARK);
    this.block("spine", [0.095, 0.085, 0.07], [0, 0.03, 0]);
    this.block("chest", [0.145, 0.15, 0.095], [0, 0.07, 0]);
    this.spindle("neck", [0, 0.085, 0.006], 0.036, DARK);
    this.block("head", [0.075, 0.115, 0.09], [0, 0.1, 0.015]);
    this.soles = [];
    for (const side of ["left", "right"]) {
      const bone = (name) => joints[`${side}_${name}`].position.toArray();
      const outward = side === "left" ? 1 : -1;
      this.ball(`${side}_upper_arm`, 0.052);
      this.spindle(`${side}_upper_arm`, bone("lower_arm"), 0.046);
      this.ball(`${side}_lower_arm`, 0.036);
      this.spindle(`${side}_lower_arm`, bone("hand"), 0.036);
      this.ball(`${side}_hand`, 0.026);
      this.block(`${side}_hand`, [0.075, 0.018, 0.036], [outward * 0.08, 0, 0.005]);
      this.ball(`${side}_upper_leg`, 0.068);
      this.spindle(`${side}_upper_leg`, bone("lower_leg"), 0.074);
      this.ball(`${side}_lower_leg`, 0.048);
      this.spindle(`${side}_lower_leg`, bone("foot"), 0.054);
      this.ball(`${side}_foot`, 0.036);
      // The ankle is 11.8 cm above the floor, the ball of the foot 3.4 cm.
      this.block(`${side}_foot`, [0.042, 0.04, 0.105], [0, -0.068, 0.045]);
      this.block(`${side}_toes`, [0.042, 0.022, 0.055], [0, -0.006, 0.03]);
      this.soles.push(this.block(`${side}_foot`, [0.043, 0.014, 0.11], [0, -0.1, 0.045], DARK.clone()));
    }
  }

  /** An ellipsoid on a joint. */
  block(joint, radii, centre, material = WOOD) {
    const mesh = new THREE.Mesh(new THREE.SphereGeometry(1, 40, 28), material);
    mesh.scale.fromArray(radii);
    mesh.position.fromArray(centre);
    this.joints[joint].add(mesh);
    return mesh;
  }

  ball(joint, radius) {
    this.block(joint, [radius, radius, radius], [0, 0, 0], DARK);
  }

  /** A turned piece from a joint to a place in its frame, thickest before the middle. */
  spindle(joint, end, radius, material = WOOD) {
    const along = new THREE.Vector3().fromArray(end);
    const length = along.length();
    const profile = Array.from({ length: 25 }, (_, i) => {
      const t = i / 24;
      const width = 0.55 + 0.45 * Math.sin(Math.PI * t ** 0.75);
      return new THREE.Vector2(radius * width * Math.sqrt(Math.sin(Math.PI * (0.04 + 0.92 * t))) || 0, length * t);
    });
    const mesh = new THREE.Mesh(new THREE.LatheGeometry(profile, 36), material);
    mesh.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), along.normalize());
    this.joints[joint].add(mesh);
  }
}
