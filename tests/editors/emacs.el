;;; What a user does in Emacs with `odgen lsp': opening files, messages, completion, hover, definition, rename.  -*- lexical-binding: t -*-
;;
;;     emacs --batch -l tests/editors/emacs.el ODGEN
;;
;; The set-up is that of docs/book/editor.md. The test waits for states, and never for a time; after PATIENCE seconds a state
;; never comes. Exit code 1 when anything differs.

(require 'cl-lib)
(require 'subr-x)

(defconst patience 60)
(defvar root (expand-file-name "../.." (file-name-directory load-file-name)))
(defvar odgen (expand-file-name (pop command-line-args-left)))
(defvar folder (file-name-as-directory (make-temp-file "odgen-emacs-" t)))
(defvar done 0)
(defvar wrong nil)

(when (fboundp 'package-initialize)
  (package-initialize))
(require 'eglot)
(require 'yaml-mode)

(defun try-check (is-right what)
  (setq done (1+ done))
  (unless is-right (push what wrong)))

(defun try-same (found expected what)
  (try-check (equal found expected) (format "%s: %S, expected %S" what found expected)))

(defun try-await (what state)
  "Wait until STATE returns something, and return that."
  (let ((end (+ (float-time) patience)) found)
    (while (and (not (setq found (funcall state))) (< (float-time) end))
      (accept-process-output nil 0.01))
    (try-check found (format "it never came to this: %s" what))
    found))

;; The files, and the set-up of the documentation as it is there.
(dolist (name (directory-files (expand-file-name "tests/editors/files" root) nil "\\.yaml\\'"))
  (copy-file (expand-file-name (concat "tests/editors/files/" name) root) folder))
(let ((default-directory folder))
  (unless (zerop (call-process odgen nil nil nil "build" "valve.od.yaml" "--out" "."))
    (error "odgen does not build")))
(make-symbolic-link odgen (concat folder "bin-odgen"))
(make-directory (concat folder "bin"))
(rename-file (concat folder "bin-odgen") (concat folder "bin/odgen"))
(add-to-list 'exec-path (concat folder "bin/"))
(setenv "PATH" (concat folder "bin:" (getenv "PATH")))
(setenv "XDG_CACHE_HOME" (concat folder "cache"))
(with-temp-buffer
  (insert-file-contents (expand-file-name "docs/book/editor.md" root))
  (unless (re-search-forward "^### Emacs\\(?:.*\n\\)*?```elisp\n\\(\\(?:.*\n\\)*?\\)```" nil t)
    (error "docs/book/editor.md shows no set-up for Emacs"))
  (let ((set-up (match-string 1)))
    (with-temp-file (concat folder "init.el") (insert set-up))
    (load (concat folder "init.el") nil t)))
(setq make-backup-files nil create-lockfiles nil
      eglot-sync-connect t eglot-autoshutdown nil)
;; Files that are not open may be changed.
(advice-add 'y-or-n-p :override (lambda (&rest _) t))

(defun try-attached ()
  (eglot-current-server))

(defun try-open (name)
  "Open the file NAME as it is on the disk, as a user does."
  (when-let ((buffer (get-file-buffer (concat folder name))))
    (with-current-buffer buffer (set-buffer-modified-p nil))
    (kill-buffer buffer))
  (switch-to-buffer (find-file-noselect (concat folder name)))
  ;; What the main loop does after a command.
  (run-hooks 'post-command-hook)
  (try-await (concat name " is attached") #'try-attached)
  (unless flymake-mode (flymake-mode 1)))

(defun try-messages ()
  "The messages about what is typed; without a user there is no idle time, in which they would be asked for."
  (eglot--signal-textDocument/didChange)
  (flymake-start)
  (mapcar (lambda (one) (cons (line-number-at-pos (flymake-diagnostic-beg one)) (flymake-diagnostic-text one)))
          (flymake-diagnostics)))

(defun try-no-messages ()
  (flymake-start)
  (null (flymake-diagnostics)))

(defun try-put (text further)
  (goto-char (point-min))
  (search-forward text)
  (goto-char (+ (match-beginning 0) further)))

(defun try-line ()
  (string-trim (thing-at-point 'line t)))

(defun try-take (text label)
  "Type TEXT, and take what is offered as LABEL."
  (insert text)
  (pcase-let* ((`(,start ,end ,table . ,rest) (eglot-completion-at-point))
               (all (completion-all-completions (buffer-substring-no-properties start end) table nil (- end start)))
               (chosen (progn (when (consp all) (setcdr (last all) nil))
                              (cl-find label all :test #'string=))))
    (try-check chosen (format "%s is not offered after %s: %S" label text all))
    (when chosen
      (delete-region start end)
      (insert chosen)
      (funcall (plist-get rest :exit-function) chosen 'finished))))

(defun try-hover ()
  (let (text)
    (eglot-hover-eldoc-function (lambda (found &rest _) (setq text found)))
    (try-await "hover" (lambda () text))))

;; Opening
(try-open "valve.od.yaml")
(try-same major-mode 'canopen-yaml-mode "the mode of a specification")
(try-await "the specification has no message" #'try-no-messages)
(try-open "node5.yaml")
(try-same major-mode 'canopen-yaml-mode "the mode of a parameter file")
(try-await "the parameter file has no message" #'try-no-messages)
(try-open "press.yaml")
(try-same major-mode 'canopen-yaml-mode "the mode of a plant")
(switch-to-buffer (find-file-noselect (concat folder "foreign.yaml")))
(run-hooks 'post-command-hook)
(try-same major-mode 'yaml-mode "the mode of a foreign file")
(try-same (try-attached) nil "the server of a foreign file")

;; Messages
(try-open "valve.od.yaml")
(try-put "unit: decibar" 6)
(kill-word 1)
(insert "decibr")
(let ((found (try-await "a message" #'try-messages)))
  (try-same (car (car found)) 11 "the line of the message")
  (try-check (string-match-p "there is no unit `decibr`" (cdr (car found))) (format "the message: %S" found)))
(backward-char)
(let ((titles (mapcar (lambda (action) (plist-get action :title)) (eglot-code-actions (point) (point)))))
  (try-check (member "Change `decibr` to `decibar`" titles) (format "the quick fixes: %S" titles)))

;; Completion
(try-open "valve.od.yaml")
(try-put "unit: decibar, access: rw" 0)
(delete-char (length "unit: decibar"))
(try-take "un" "unit")
(try-check (string-match-p "type: unsigned16, unit: , access" (try-line)) (format "a key: %s" (try-line)))
(try-take "bar" "decibar")
(try-check (string-match-p "type: unsigned16, unit: decibar, access" (try-line)) (format "a unit by its symbol: %s" (try-line)))
(try-put "map: [set pressure]" 6)
(delete-char (length "set pressure"))
(try-take "set" "set pressure")
(try-same (try-line) "receive: {1: {map: [set pressure]}}" "a name with a space")

;; Hover and definition
(try-open "press.yaml")
(try-put "set pressure: 5.8" 2)
(try-check (string-match-p "set pressure" (or (try-hover) "")) "hover in a plant")
(xref-find-definitions "LSP identifier at point.")
(try-same (file-name-nondirectory (buffer-file-name)) "valve.od.yaml" "the file of the definition")
(try-same (line-number-at-pos) 11 "the line of the definition")

;; Rename
(try-open "valve.od.yaml")
(try-put "set pressure" 2)
(eglot-rename "target pressure")
(try-check (string-match-p "name: target pressure" (try-line)) (format "the name: %s" (try-line)))
(dolist (name '("node5.yaml" "press.yaml"))
  (with-current-buffer (find-file-noselect (concat folder name))
    (try-check (save-excursion (goto-char (point-min)) (search-forward "target pressure" nil t))
           (concat name " has the old name"))
    (set-buffer-modified-p nil)))

;; An EDS in Windows-1252
(with-temp-buffer
  (set-buffer-multibyte nil)
  (insert-file-contents-literally (concat folder "eds/valve.eds"))
  (re-search-forward "^VendorName=[^\r\n]*")
  (replace-match "VendorName=M\374ller Ventile" t t)
  (let ((coding-system-for-write 'binary))
    (write-region nil nil (concat folder "latin1.eds") nil 'silent)))
(try-open "latin1.eds")
(try-same major-mode 'canopen-eds-mode "the mode of an EDS")
(try-check (save-excursion (goto-char (point-min)) (search-forward "Müller" nil t)) "an EDS is not read as Windows-1252")
(try-put "[1600sub1]" 0)
(search-forward "DefaultValue=0x2000")
(try-check (string-match-p "set pressure" (or (try-hover) "")) "hover over a mapping value")
(xref-find-definitions "LSP identifier at point.")
(try-same (try-line) "[2000]" "the section of a mapped object")
(search-forward "AccessType=")
(delete-region (point) (line-end-position))
(try-take "r" "rww")
(try-same (try-line) "AccessType=rww" "an access type")

(ignore-errors (eglot-shutdown-all))
(delete-directory folder t)
(dolist (what (reverse wrong))
  (message "%s" what))
(message "%d passed, %d failed in Emacs %s" (- done (length wrong)) (length wrong) emacs-version)
(kill-emacs (if wrong 1 0))
