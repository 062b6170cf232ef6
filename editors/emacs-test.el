;;; Run by editors/emacs-test in Emacs without a window.  -*- lexical-binding: t -*-

(require 'cl-lib)
(setq eglot-sync-connect 60 eglot-autoshutdown nil)

(defun check (text is)
  (message "%s %s" (if is "ok  " "FAILED:") text)
  (unless is (kill-emacs 1)))

(defun wait (text is)
  (let ((tries 0))
    (while (and (< tries 600) (not (funcall is)))
      (accept-process-output nil 0.1)
      (cl-incf tries))
    (check text (funcall is))))

(defun ask (method)
  (jsonrpc-request (eglot-current-server) method (eglot--TextDocumentPositionParams) :timeout 60))

(find-file "my.pf")
(check "a .pf file is a form" (eq major-mode 'postform-mode))
;; what `eglot-ensure' does after a command of a person
(apply #'eglot--connect (eglot--guess-contact))
(wait "the server is attached" #'eglot-managed-p)

(goto-char (point-min))
(search-forward "R[vcl")
(check "hover explains"
       (string-match-p "clearance plane" (plist-get (plist-get (ask :textDocument/hover) :contents) :value)))
(check "a line leads to its blocks" (= 4 (length (ask :textDocument/implementation))))
(check "variables are completed"
       (cl-some (lambda (item) (equal (plist-get item :label) "vclear")) (ask :textDocument/completion)))

(goto-char (point-min))
(search-forward "X[h")
(insert "h")
(eglot--signal-textDocument/didChange)
(wait "a wrong word is underlined" (lambda () (flymake-diagnostics)))
(delete-char -1)
(eglot--signal-textDocument/didChange)
(wait "and no more when it is right" (lambda () (not (flymake-diagnostics))))
(set-buffer-modified-p nil)
(message "Emacs %s: all of it" emacs-version)
