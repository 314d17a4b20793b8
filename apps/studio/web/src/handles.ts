// Handles to move and turn the chosen part: arrows, planes and rings.
import * as THREE from 'three';
import { TransformControls } from 'three/examples/jsm/controls/TransformControls.js';
import type { View } from './view';

export class Handles {
  grabbed = false;
  onMove: (motion: THREE.Matrix4) => void = () => undefined;
  private readonly anchor = new THREE.Object3D();
  private readonly controls: TransformControls;
  private readonly home = new THREE.Matrix4();

  constructor(private readonly view: View, release: (motion: THREE.Matrix4) => void) {
    this.controls = new TransformControls(view.camera, view.canvas);
    this.controls.setSize(0.75);
    this.controls.setRotationSnap(Math.PI / 60);
    view.scene.add(this.anchor, this.controls.getHelper());
    this.controls.addEventListener('change', () => view.render());
    this.controls.addEventListener('mouseDown', () => {
      this.grabbed = true;
      this.view.orbit.enabled = false;
    });
    this.controls.addEventListener('objectChange', () => this.onMove(this.motion()));
    this.controls.addEventListener('mouseUp', () => {
      this.grabbed = false;
      this.view.orbit.enabled = true;
      const motion = this.motion(), still = motion.elements.every((x, k) => Math.abs(x - (k % 5 === 0 ? 1 : 0)) < 1e-9);
      if (!still) release(motion);
    });
    this.attach(null);
  }

  get mode(): 'translate' | 'rotate' {
    return this.controls.mode as 'translate' | 'rotate';
  }

  set mode(mode: 'translate' | 'rotate') {
    this.controls.setMode(mode);
    this.view.render();
  }

  private motion(): THREE.Matrix4 {
    this.anchor.updateMatrix();
    return this.anchor.matrix.clone().multiply(this.home.clone().invert());
  }

  attach(at: THREE.Vector3 | null): void {
    if (this.grabbed) return;
    this.controls.enabled = at !== null;
    if (!at) {
      this.controls.detach();
      this.view.render();
      return;
    }
    this.anchor.position.copy(at);
    this.anchor.quaternion.identity();
    this.anchor.updateMatrix();
    this.home.copy(this.anchor.matrix);
    this.controls.attach(this.anchor);
    this.view.render();
  }
}
